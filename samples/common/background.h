// The scene's sky behind what the SDK lit.
#pragma once

#include "common/frame_loop.h"
#include "common/gbuffer.h"

namespace samples {

class BackgroundPass {
public:
    // `target` in VK_IMAGE_LAYOUT_GENERAL.
    BackgroundPass(const Device& device, const GpuScene& scene, const GBufferPass& gbuffer,
                   VkImageView target, VkExtent2D extent);

    // Behind the SDK's passes; leaves the depth image in VK_IMAGE_LAYOUT_GENERAL until the next G-buffer.
    void record(VkCommandBuffer cmd, const CameraPose& pose, glm::vec2 jitter) const;

private:
    const GBufferPass& gbuffer_;
    VkExtent2D extent_;
    ComputePass pass_;
};

}   // namespace samples
