// A ray tracing pipeline of the samples' own: a ray generation shader, the library's miss and closest-hit shaders, the scene's
// alpha test.
#pragma once

#include <span>

#include "common/gpu_memory.h"

namespace samples {

class RayLaunch {
public:
    // `layout` has the scene in set 1 and outlives this. The device has ray pipelines (Device::hasRayPipelines()).
    RayLaunch(const Device& device, VkPipelineLayout layout, std::span<const uint32_t> raygen);
    ~RayLaunch();
    RayLaunch(const RayLaunch&) = delete;
    RayLaunch& operator=(const RayLaunch&) = delete;

    // Sets and push constants have been recorded.
    void record(VkCommandBuffer cmd, VkExtent2D extent) const;

private:
    void makePipeline(VkPipelineLayout layout, std::span<const uint32_t> raygen);
    void makeTable();

    const Device& device_;
    VkPipeline pipeline_ = VK_NULL_HANDLE;
    Buffer table_;   // a record of each group, `stride_` apart
    VkDeviceAddress address_ = 0;
    VkDeviceSize stride_ = 0;
};

}   // namespace samples
