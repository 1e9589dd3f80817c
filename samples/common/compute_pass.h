// A compute pipeline of the samples' own: storage images in set 0, the scene in set 1, push constants.
#pragma once

#include <span>
#include <vector>

#include "common/gpu_scene.h"

namespace samples {

class ComputePass {
public:
    // Binding i of set 0 is images[i], in VK_IMAGE_LAYOUT_GENERAL; storage buffers follow. Shaders are 8x8.
    ComputePass(const Device& device, const GpuScene& scene, std::span<const uint32_t> spirv,
                std::span<const VkImageView> images, uint32_t constantsSize,
                std::span<const VkBuffer> buffers = {});
    ~ComputePass();
    ComputePass(const ComputePass&) = delete;
    ComputePass& operator=(const ComputePass&) = delete;

    template <class Constants>
    void record(VkCommandBuffer cmd, VkExtent2D extent, const Constants& constants) const {
        dispatch(cmd, extent, std::as_bytes(std::span(&constants, 1)));
    }

private:
    void makeSet(std::span<const VkImageView> images, std::span<const VkBuffer> buffers);
    void makePipeline(std::span<const uint32_t> spirv, uint32_t constantsSize);
    void dispatch(VkCommandBuffer cmd, VkExtent2D extent, std::span<const std::byte> constants) const;
    void release();

    const Device& device_;
    const GpuScene& scene_;
    VkDescriptorSetLayout setLayout_ = VK_NULL_HANDLE;
    VkDescriptorPool pool_ = VK_NULL_HANDLE;
    VkDescriptorSet set_ = VK_NULL_HANDLE;
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
    VkPipeline pipeline_ = VK_NULL_HANDLE;
};

}   // namespace samples
