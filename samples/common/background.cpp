#include "common/background.h"

#include <restir/session.h>

#include "background.spv.h"

namespace samples {
namespace {

// Constants in background.glsl.
struct Constants {
    CameraPose pose;
    uint32_t extent[2];
    glm::vec2 jitter;
};
static_assert(sizeof(Constants) == 64);

}   // namespace

BackgroundPass::BackgroundPass(const Device& device, const GpuScene& scene, const GBufferPass& gbuffer,
                               VkImageView target, VkExtent2D extent)
    : extent_(extent),
      pass_(device, scene, k_background_spv, std::array{target, gbuffer.depth().view()}, sizeof(Constants)) {}

void BackgroundPass::record(VkCommandBuffer cmd, const restir::Scope& out, const CameraPose& pose, glm::vec2 jitter) const {
    memoryBarrier(cmd, {out.stages, out.access},
                  {VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT});
    pass_.record(cmd, extent_, Constants{pose, {extent_.width, extent_.height}, jitter});
}

}   // namespace samples
