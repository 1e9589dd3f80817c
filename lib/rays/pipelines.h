// RayBackend::Pipeline: passes that trace as ray generation shaders, and their shader binding table.
#pragma once

#include <device/buffers.h>
#include <restir/context.h>

namespace restir {

// The stages that all such passes share.
struct RayStages {
    const ShaderPack::Module* miss = nullptr;
    const ShaderPack::Module* closestHit = nullptr;
    const ShaderPack::Module* anyHit = nullptr;
};

VkResult makeModule(const Device& device, const ShaderPack::Module& module, VkShaderModule& shader) noexcept;
VkResult makeRayPipeline(const Device& device, VkPipelineLayout layout, const ShaderPack::Module& pass, const RayStages& stages,
                         VkPipeline& pipeline) noexcept;

class BindingTable {
public:
    // One record for each stage of each pipeline, which set() writes.
    static Result<BindingTable> create(const Device& device, uint32_t pipelines) noexcept;
    VkResult set(const Device& device, uint32_t index, VkPipeline pipeline) const noexcept;
    void trace(const Device& device, VkCommandBuffer cmd, uint32_t pipeline, uint32_t width, uint32_t height) const noexcept;

private:
    Buffers buffers_;
    VkDeviceAddress address_ = 0;
    uint8_t* records_ = nullptr;   // what is there
    VkDeviceSize stride_ = 0;      // of records
    uint32_t handleSize_ = 0;
};

}   // namespace restir
