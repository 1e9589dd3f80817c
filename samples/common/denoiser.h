// A display denoiser for the samples: what a host does with the SDK's lobes. Averages over frames along the
// motion, as long as Output::gradient says that light stays, then over neighbours on the same surface, each
// lobe without its surface's colour. Biased, as all of its kind; quiet at one sample a pixel.
#pragma once

#include <array>
#include <memory>

#include <restir/settings.h>

#include "common/gbuffer.h"

namespace samples {

class Denoiser {
public:
    // `target` gets the picture, in VK_IMAGE_LAYOUT_GENERAL.
    Denoiser(const Device& device, const GpuScene& scene, const GBufferPass& gbuffer, VkImageView target,
             VkExtent2D extent);
    ~Denoiser();

    // What a frame with `settings` is to write for it, instead of the picture.
    void ask(restir::Output& output, const restir::Settings& settings) const;
    // Behind the SDK's passes, which wrote in `out`, and GBufferPass::share().
    void record(VkCommandBuffer cmd, const restir::Scope& out, const restir::Settings& settings, const CameraPose& pose,
                const CameraPose& previous);
    void reset() { history_ = false; }   // the next frame has no last one

private:
    struct Images;
    std::unique_ptr<Images> images_;
    VkExtent2D extent_;
    bool history_ = false;
    std::unique_ptr<ScenePass> temporal_, compose_;
    std::array<std::unique_ptr<ScenePass>, 4> filters_;
};

}   // namespace samples
