// A view of a stage: the images of its size, and the passes that fill them.
#pragma once

#include <memory>
#include <optional>

#include "common/background.h"
#include "common/denoiser.h"
#include "common/reference.h"
#include "viewer/display.h"
#include "viewer/pass_clock.h"
#include "viewer/stage.h"

namespace viewer {

// One frame, as the viewer wants it.
struct Shot {
    samples::Frame frame;
    samples::Motion motion = {};
    restir::Settings settings;
    DisplaySettings display;
    bool denoise = false;
};

class Picture {
public:
    // Borrows both.
    Picture(samples::Device& device, Stage& stage);

    // Makes what frames of that size with these settings need, where it has not got it.
    struct Fitted {
        bool waited = false;    // for the GPU, to make something
        bool cleared = false;   // what was accumulated is gone
    };
    Fitted fit(VkExtent2D extent, const restir::Settings& settings);

    // Refused: the SDK's message is Device::sdkError(), and the picture stays.
    restir::Status record(VkCommandBuffer cmd, const Shot& shot);
    bool waited() const { return waited_; }   // the last record(), for pipelines to be made

    VkExtent2D extent() const { return extent_; }
    // Of the slot's last frame, which the GPU is done with: of the library's passes and of the host's,
    // "host.NAME".
    std::vector<restir::PassTiming> timings(uint32_t slot);
    restir::Counters counters(uint32_t slot) const { return session_->counters(slot); }
    Display& display() { return *images_->display; }
    const samples::GpuImage& radiance() const { return images_->radiance; }   // in VK_IMAGE_LAYOUT_GENERAL
    std::vector<restir::BufferInfo> memory() const;                           // the SDK's

private:
    // Replaced when the size changes.
    struct Images {
        Images(const samples::Device& device, const samples::GpuScene& scene, VkExtent2D extent);

        samples::GpuImage radiance, debug, paths;
        samples::GBufferPass gbuffer;
        std::unique_ptr<samples::BackgroundPass> background;   // null: the scene has no sky
        std::unique_ptr<samples::Denoiser> denoiser;           // null until it is wanted
        samples::ReferencePass reference;
        std::unique_ptr<Display> display;
    };

    void moveScene(VkCommandBuffer cmd, const Shot& shot);

    samples::Device& device_;
    Stage& stage_;
    VkExtent2D extent_{};
    std::unique_ptr<Images> images_;
    PassClock clock_;
    restir::SessionDesc declared_;
    std::optional<restir::Session>
        session_;           // outlives changes of size up to the declared one, and keeps its history
    bool waited_ = false;
    bool resting_ = true;   // the last frame left the scene as the one before had
};

}   // namespace viewer
