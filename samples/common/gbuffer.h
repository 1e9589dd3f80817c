// A host's G-buffer, made by primary rays.
#pragma once

#include <array>

#include <restir/frame.h>

#include "common/camera.h"
#include "common/scene_pass.h"

namespace samples {

class GBufferPass {
public:
    GBufferPass(const Device& device, const GpuScene& scene, VkExtent2D extent);

    // Records the dispatch and its barriers: `readers` are whoever reads the images, before and after.
    void record(VkCommandBuffer cmd, const CameraPose& pose, const CameraPose& previous, glm::vec2 jitter,
                const restir::Scope& readers) const;

    // Behind the SDK's passes: for reading as storage images, in VK_IMAGE_LAYOUT_GENERAL until the next record().
    void share(VkCommandBuffer cmd, const restir::Scope& readers) const;

    VkExtent2D extent() const { return extent_; }
    // As the SDK takes it.
    restir::GBuffer describe() const;
    const GpuImage& depth() const { return images_[Depth]; }   // -1 where there is no surface

private:
    enum Name : uint8_t { Depth, Normal, GeometricNormal, BaseColor, Material, Motion, Emission, Count };

    std::array<VkImageView, Count> views() const;

    VkExtent2D extent_;
    std::array<GpuImage, Count> images_;
    ScenePass pass_;
};

}   // namespace samples
