// A ray tracing pipeline of the samples' own, for lists of rays: one shader of each stage, the scene in set 1, push constants.
#pragma once

#include <span>

#include "common/gpu_scene.h"

namespace samples {

class RayLaunch {
public:
    // The device has ray pipelines (Device::hasRayPipelines()).
    RayLaunch(const Device& device, const GpuScene& scene, uint32_t constantsSize);
    ~RayLaunch();
    RayLaunch(const RayLaunch&) = delete;
    RayLaunch& operator=(const RayLaunch&) = delete;

    template <class Constants>
    void record(VkCommandBuffer cmd, VkExtent2D extent, const Constants& constants) const {
        trace(cmd, extent, std::as_bytes(std::span(&constants, 1)));
    }

private:
    void makeLayout(uint32_t constantsSize);
    void makePipeline();
    void makeTable();
    void trace(VkCommandBuffer cmd, VkExtent2D extent, std::span<const std::byte> constants) const;
    void release();

    const Device& device_;
    const GpuScene& scene_;
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
    VkPipeline pipeline_ = VK_NULL_HANDLE;
    Buffer table_;   // a record of each group, `stride_` apart
    VkDeviceAddress address_ = 0;
    VkDeviceSize stride_ = 0;
};

}   // namespace samples
