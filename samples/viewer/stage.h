// A scene on the GPU and what of the SDK is made for it; all that a scene switch replaces.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "common/lighting.h"
#include "common/scene_options.h"

namespace viewer {

struct SceneCounts {
    uint64_t triangles = 0, emissiveTriangles = 0, lights = 0, instances = 0, materials = 0, textures = 0;
};

struct Stage {
    std::string name;
    SceneCounts counts;
    std::vector<samples::View> views;             // at least one: the options' or the scene's first
    std::vector<samples::Animation> animations;   // the scene's, and one that dims and brightens its lights
    std::vector<std::string> warnings;
    double loadSeconds = 0;
    std::unique_ptr<samples::GpuScene> scene;
    std::unique_ptr<samples::Lighting> lighting;
};

// Throws std::runtime_error.
Stage makeStage(samples::Device& device, const samples::SceneOptions& options,
                const samples::LightingDesc& lighting);

}   // namespace viewer
