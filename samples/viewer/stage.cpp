#include "viewer/stage.h"

#include <chrono>
#include <cmath>

namespace viewer {
namespace {

constexpr float kPulseFrames = 60;   // from bright to bright

// For scenes that bring no motion of lights: every material and every lamp in a rhythm of its own.
void pulse(float time, samples::SceneState& state) {
    const auto factor = [&](size_t index) {
        const float phase = 6.2831853f * (time / kPulseFrames + 0.618034f * static_cast<float>(index));
        return 0.55f + 0.45f * std::cos(phase);
    };
    for (size_t i = 0; i < state.emission.size(); ++i) state.emission[i] *= factor(i);
    for (size_t i = 0; i < state.punctual.size(); ++i) state.punctual[i].intensity *= factor(i);
}

}   // namespace

Stage makeStage(samples::Device& device, const samples::SceneOptions& options,
                const samples::LightingDesc& lighting) {
    const auto start = std::chrono::steady_clock::now();
    Stage stage;
    stage.name = options.scene;
    samples::SceneData data = samples::load(options, stage.warnings);
    stage.views = data.views;
    const samples::View chosen = samples::chooseView(options, data);
    const bool listed = options.eye.empty() && !data.views.empty();
    if (!listed) stage.views.insert(stage.views.begin(), chosen);
    if (listed && options.camera) std::swap(stage.views.front(), stage.views[*options.camera]);
    stage.animations = data.animations;
    stage.animations.push_back({"pulse", pulse});
    stage.counts.instances = data.instances.size();
    stage.counts.materials = data.materials.size();
    stage.counts.textures = data.textures.size();
    stage.scene = std::make_unique<samples::GpuScene>(device, std::move(data));
    stage.counts.triangles = stage.scene->triangleCount();
    stage.counts.emissiveTriangles = stage.scene->emissiveTriangleCount();
    stage.counts.lights = stage.scene->lights().size();
    stage.lighting = std::make_unique<samples::Lighting>(device, *stage.scene, lighting);
    stage.loadSeconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return stage;
}

}   // namespace viewer
