// Which scene, under which sky, seen from where: what programs that show a scene are told on their command
// lines.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <vulkan/vulkan_core.h>

#include "common/scene.h"

namespace CLI {
class App;
}

namespace samples {

inline constexpr const char* kSceneHelp =
    "a .gltf or .glb file, or builtin:cornell, builtin:rooms, builtin:market, builtin:city, builtin:street, "
    "builtin:lamps";

struct SceneOptions {
    std::string scene;               // a file, or builtin:NAME
    std::string environment = {};    // empty: the scene's own sky, if any
    float environmentRotation = 0;   // degrees
    float environmentScale = 1;
    bool lambert = false;   // makeLambert()
    std::optional<uint32_t> camera = {};
    std::string eye = {}, target = {};   // X,Y,Z
    float fov = 45;                      // degrees, vertical; with eye and target
};

// WxH, each side in [1, 16384]. Throws std::runtime_error.
VkExtent2D parseSize(const std::string& text);
// --size WxH into `extent`; `help` says of what.
void addSize(CLI::App& app, VkExtent2D& extent, const std::string& help);

// --rays: how the SDK traces.
void addRays(CLI::App& app, std::optional<restir::RayBackend>& rays);
struct RayBackendName {
    restir::RayBackend backend;
    const char* name;
    const char* help;
};
std::span<const RayBackendName> rayBackends();   // that samples can choose
const RayBackendName& rayBackend(std::string_view name);   // throws std::runtime_error naming those there are
const RayBackendName& rayBackend(restir::RayBackend backend);

// All but the scene's name. `options` must outlive the parsing.
void addSceneOptions(CLI::App& app, SceneOptions& options);

// Scene and view as they would be written on a command line, the map without its directory: to tell measurements apart.
std::string sceneText(const SceneOptions& options);

// Throws std::runtime_error naming what cannot be had; `warnings` as of loadGltf() and loadSky().
SceneData load(const SceneOptions& options, std::vector<std::string>& warnings);
// The options' camera, else the scene's first, else one that frames the scene. Throws std::runtime_error,
// without a scene, too, for what cannot be.
void checkView(const SceneOptions& options);
View chooseView(const SceneOptions& options, const SceneData& scene);

}   // namespace samples
