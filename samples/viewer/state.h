// What the panels, the keys and a script change.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <restir/device.h>
#include <restir/settings.h>
#include <vulkan/vulkan_core.h>

#include "viewer/fly_camera.h"

namespace viewer {

struct PresetName {
    const char* name;
    restir::Preset preset;
};
inline constexpr PresetName kPresets[] = {{"fast", restir::Preset::Fast},
                                          {"balanced", restir::Preset::Balanced},
                                          {"quality", restir::Preset::Quality},
                                          {"unbiased", restir::Preset::Unbiased}};

struct State {
    restir::RayBackend rays = restir::RayBackend::RayQuery;
    restir::Settings settings;
    FlyCamera camera;
    bool cut = true;   // the next frame shows nothing of the last one's

    float scale = 1;      // pixels rendered for one of the window's, a side
    bool smooth = true;   // where that is not 1
    bool autoExposure = true;
    float exposure = 1;     // where that is automatic, of the last frame
    bool adapted = false;   // to what is in view; else automatic exposure jumps there
    bool split = false;     // the reference to the right of the line
    float line = 0.5f;      // of the width
    bool draggingLine = false;
    bool denoise = false;
    bool measure = false;   // trace the reference to measure the error, whether it is seen or not
    bool panels = true;

    size_t animation = 0;
    bool playing = false;
    float time = 0, pace = 1;   // frames of the animation, and for each of the viewer's

    // Wishes for the next frame.
    std::string load;   // a scene
    std::optional<VkExtent2D> windowSize;
    std::vector<std::string> savePictures;   // files
    std::string saveWindow;                  // likewise
    bool quit = false;

    uint32_t compilations = 0;   // of shaders that changed, whatever became of them
    std::string message;   // the last wish that could not be met
    std::string refusal;   // what the library has against the settings; empty: nothing

    bool tracesReference() const { return split || measure; }
    void lookThrough(const samples::View& view);
    void saveScreenshot();   // under names that are free
};

}   // namespace viewer
