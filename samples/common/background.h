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

    // Behind the SDK's passes, which wrote in `out`, and GBufferPass::share().
    void record(VkCommandBuffer cmd, const restir::Scope& out, const CameraPose& pose, glm::vec2 jitter) const;

private:
    VkExtent2D extent_;
    ScenePass pass_;
};

}   // namespace samples
