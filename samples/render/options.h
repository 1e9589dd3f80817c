// The command line of restir-render.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <vulkan/vulkan_core.h>

#include <restir/settings.h>

#include "common/lighting.h"
#include "common/scene_options.h"

namespace render {

struct Options {
    samples::SceneOptions scene;
    VkExtent2D size{640, 360};
    std::string mode = "di";   // "reference", "ris", or one that samples::modeText() knows
    uint32_t frames = 0;       // 0: as many as the mode needs to settle
    uint32_t spp = 1;
    uint32_t bounces = 0;   // 0: as many as the mode has by itself
    restir::Settings settings;
    bool reference() const { return mode == "reference"; }
    bool debugs() const { return settings.debugView != restir::DebugView::None; }
    bool accumulate = false;
    bool denoise = false;
    bool validate = false;
    bool quiet = false;
    bool referenceNextEvent = true;
    uint32_t seed = 0;
    float move = 0;          // degrees a frame
    std::string animation;   // of the scene's; empty: it stands still
    bool jitter = false;
    bool previousTlas = true;
    samples::LightingDesc lighting;
    std::string exr, png, stats;
};

// Nothing after --help or --version, which are answered here. Throws std::runtime_error for anything that
// cannot be done.
std::optional<Options> parseOptions(int argc, const char* const* argv);

}   // namespace render
