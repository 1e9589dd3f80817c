// A host of the SDK: G-buffer, lights, session, frames in flight, a picture at the end.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <restir/restir.h>

#include "common/background.h"
#include "common/denoiser.h"
#include "common/frame_loop.h"
#include "common/gbuffer.h"
#include "common/lighting.h"

namespace samples {

struct PassStats {
    std::string name;
    uint32_t firstFrame = 0;            // that had it: temporal reuse starts with the second
    std::vector<double> milliseconds;   // GPU time in each frame from there; passes of one name are added up
};

struct RenderStats {
    std::vector<PassStats> passes;
    // Of the last frame, the only one that counts them: counting costs atomics.
    restir::Counters counters;
};

// Renders any number of sequences with any settings; only the constructor makes pipelines.
class Renderer {
public:
    // `session` declares what its settings need (declareFor()); its maxExtent is `extent`.
    Renderer(Device& device, GpuScene& scene, VkExtent2D extent, restir::SessionDesc session = {},
             const LightingDesc& lighting = {});

    // Forgets all history first. With settings.debugView the picture is Output::debug of the last frame.
    FloatImage render(const Sequence& sequence, const restir::Settings& settings,
                      const std::function<void(uint32_t done, uint32_t all)>& progress = {});

    const RenderStats& stats() const { return stats_; }   // of the last render()
    // What the SDK holds for this view, then for the scene.
    std::vector<restir::BufferInfo> memory() const;
    restir::Session& session() { return session_; }

private:
    void record(VkCommandBuffer cmd, const Sequence& sequence, const Frame& frame);
    void collect(const Frame& frame, std::span<const float> target);
    bool debugs() const { return settings_.debugView != restir::DebugView::None; }

    Device& device_;
    GpuScene& scene_;
    FrameLoop loop_;
    GpuImage unseen_;   // takes the radiance where something else is looked at
    GBufferPass gbuffer_;
    std::unique_ptr<BackgroundPass> background_;   // null: the scene has no sky
    std::unique_ptr<Denoiser> denoiser_;           // from the first sequence on that wants it
    Lighting lighting_;
    restir::Session session_;
    restir::Settings settings_;   // of the sequence, as its alpha
    std::vector<float> alpha_;
    RenderStats stats_;
};

}   // namespace samples
