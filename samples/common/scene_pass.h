// A pass of the samples' own: storage images and buffers in set 0, the scene in set 1, push constants.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "common/gpu_scene.h"
#include "common/ray_launch.h"

namespace samples {

struct PassShader {
    template <class Words>
    PassShader(const Words& words, bool isRaygen = false) : spirv(words), raygen(isRaygen) {}

    std::span<const uint32_t> spirv;
    bool raygen;   // of a ray tracing pipeline (Device::hasRayPipelines()); else compute, in groups of 8x8
};

// Of a shader that includes scene_trace.glsl, compiled for both: ray query where the device has it.
PassShader tracingShader(const Device& device, std::span<const uint32_t> query, std::span<const uint32_t> raygen);

class ScenePass {
public:
    // Binding i of set 0 is images[i], in VK_IMAGE_LAYOUT_GENERAL; storage buffers follow.
    ScenePass(const Device& device, const GpuScene& scene, const PassShader& shader,
              std::span<const VkImageView> images, uint32_t constantsSize,
              std::span<const VkBuffer> buffers = {});
    ~ScenePass();
    ScenePass(const ScenePass&) = delete;
    ScenePass& operator=(const ScenePass&) = delete;

    // A thread for each pixel of `extent` at least.
    template <class Constants>
    void record(VkCommandBuffer cmd, VkExtent2D extent, const Constants& constants) const {
        run(cmd, extent, std::as_bytes(std::span(&constants, 1)));
    }
    // A thread for each item of a list, and more: its index is sceneThreadIndex().
    template <class Constants>
    void recordList(VkCommandBuffer cmd, uint32_t items, const Constants& constants) const {
        record(cmd, listExtent(items), constants);
    }
    VkPipelineStageFlags2 stage() const;   // that reads and writes

private:
    void makeSet(std::span<const VkImageView> images, std::span<const VkBuffer> buffers);
    void makeLayout(uint32_t constantsSize);
    VkExtent2D listExtent(uint32_t items) const;
    void run(VkCommandBuffer cmd, VkExtent2D extent, std::span<const std::byte> constants) const;
    void release();

    const Device& device_;
    const GpuScene& scene_;
    VkShaderStageFlags stages_;
    VkDescriptorSetLayout setLayout_ = VK_NULL_HANDLE;
    VkDescriptorPool pool_ = VK_NULL_HANDLE;
    VkDescriptorSet set_ = VK_NULL_HANDLE;
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
    VkPipeline pipeline_ = VK_NULL_HANDLE;   // of compute
    std::unique_ptr<RayLaunch> launch_;      // or this
};

}   // namespace samples
