// The command line of restir-viewer.
#pragma once

#include <optional>
#include <string>

#include <restir/settings.h>
#include <vulkan/vulkan_core.h>

#include "common/scene_options.h"

namespace viewer {

struct Options {
    samples::SceneOptions scene;
    std::optional<restir::RayBackend> rays;   // unset: the best of the device
    restir::Settings settings;
    VkExtent2D window{1280, 720};
    std::optional<float> scale;   // unset: 1 on a GPU, less where the CPU has to do
    std::string bridge;           // a directory; empty: the library as it was built
    std::string script;           // a file
    double seconds = 0;           // the script begins anew until they have passed
    bool validate = false;
};

// Nothing after --help, which is answered here. Throws std::runtime_error.
std::optional<Options> parseOptions(int argc, const char* const* argv);

}   // namespace viewer
