#include "common/gbuffer.h"

#include <restir/session.h>

#include "gbuffer.spv.h"
#include "gbuffer_raygen.spv.h"

namespace samples {
namespace {

// Constants in gbuffer.glsl.
struct Constants {
    CameraPose pose, previous;
    uint32_t extent[2];
    glm::vec2 jitter;
};
static_assert(sizeof(Constants) == 112);

constexpr float kEmptyDepth = -1;   // in gbuffer.glsl, too
constexpr std::array kFormats = {VK_FORMAT_R32_SFLOAT,          VK_FORMAT_R16G16_SNORM,
                                 VK_FORMAT_R16G16_SNORM,        VK_FORMAT_R16G16B16A16_SFLOAT,
                                 VK_FORMAT_R16G16B16A16_SFLOAT, VK_FORMAT_R32G32_SFLOAT,
                                 VK_FORMAT_R16G16B16A16_SFLOAT};

template <size_t Count>
std::array<GpuImage, Count> makeImages(const Device& device, VkExtent2D extent) {
    static_assert(Count == kFormats.size());
    std::array<GpuImage, Count> images;
    for (size_t i = 0; i < Count; ++i) {
        images[i] =
            GpuImage(device, extent, kFormats[i], VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT);
    }
    return images;
}

}   // namespace

GBufferPass::GBufferPass(const Device& device, const GpuScene& scene, VkExtent2D extent)
    : extent_(extent),
      images_(makeImages<Count>(device, extent)),
      pass_(device, scene, tracingShader(device, k_gbuffer_spv, k_gbuffer_raygen_spv), views(), sizeof(Constants)) {}

std::array<VkImageView, GBufferPass::Count> GBufferPass::views() const {
    std::array<VkImageView, Count> result;
    for (size_t i = 0; i < Count; ++i) result[i] = images_[i].view();
    return result;
}

void GBufferPass::record(VkCommandBuffer cmd, const CameraPose& pose, const CameraPose& previous,
                         glm::vec2 jitter, const restir::Scope& readers) const {
    const Access before{readers.stages, 0,
                        VK_IMAGE_LAYOUT_UNDEFINED};   // last frame's contents are done with
    const Access write{pass_.stage(), VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
                       VK_IMAGE_LAYOUT_GENERAL};
    const Access after{readers.stages, readers.access, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
    std::array<VkImageMemoryBarrier2, Count> barriers;
    for (size_t i = 0; i < Count; ++i) barriers[i] = imageBarrier(images_[i], before, write);
    pipelineBarrier(cmd, barriers);
    pass_.record(cmd, extent_, Constants{pose, previous, {extent_.width, extent_.height}, jitter});
    for (size_t i = 0; i < Count; ++i) barriers[i] = imageBarrier(images_[i], write, after);
    pipelineBarrier(cmd, barriers);
}

void GBufferPass::share(VkCommandBuffer cmd, const restir::Scope& readers) const {
    const Access from{readers.stages, 0, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
    const Access to{VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_READ_BIT, VK_IMAGE_LAYOUT_GENERAL};
    std::array<VkImageMemoryBarrier2, Count> barriers;
    for (size_t i = 0; i < Count; ++i) barriers[i] = imageBarrier(images_[i], from, to);
    pipelineBarrier(cmd, barriers);
}

restir::GBuffer GBufferPass::describe() const {
    return {.depth = {images_[Depth].view()},
            .normal = {images_[Normal].view()},
            .geometricNormal = {images_[GeometricNormal].view()},
            .baseColor = {images_[BaseColor].view()},
            .material = {images_[Material].view()},
            .motion = {images_[Motion].view()},
            .emission = {images_[Emission].view()},
            .normals = restir::NormalEncoding::Octahedral,
            .depthKind = restir::DepthKind::Linear,
            .emptyDepth = kEmptyDepth};
}

}   // namespace samples
