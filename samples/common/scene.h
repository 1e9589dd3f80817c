// A scene on the CPU: what the importers and generators make and GpuScene uploads.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include <restir/lights.h>
#include <restir/shared/scene.h>

#include "common/image_io.h"

namespace samples {

// 8-bit RGBA, row 0 on top. `srgb` says how its colour channels are encoded.
struct Image {
    uint32_t width = 0, height = 0;
    std::vector<uint8_t> rgba = {};
    bool srgb = false;
};

enum class Wrap : uint8_t { Repeat, Mirror, Clamp };

struct Texture {
    uint32_t image = 0;
    Wrap wrapU = Wrap::Repeat, wrapV = Wrap::Repeat;
    bool nearest = false;
};

// One glTF primitive: indexed triangles of one material. `normals` and `uvs` may be empty.
struct Geometry {
    std::vector<glm::vec3> positions = {};
    std::vector<glm::vec3> normals = {};
    std::vector<glm::vec2> uvs = {};
    std::vector<uint32_t> indices = {};   // three per triangle, no zero-index checks left to do
    uint32_t material = 0;
};

struct Mesh {
    std::vector<Geometry> geometries;
};

struct Instance {
    uint32_t mesh = 0;
    glm::mat4 worldFromObject{1.0f};
};

enum class PunctualKind : uint8_t { Point, Spot, Directional };

struct PunctualLight {
    PunctualKind kind = PunctualKind::Point;
    glm::vec3 position{0}, direction{0, 0, -1};      // world space; direction of travel, unit
    glm::vec3 intensity{1};                          // point, spot: candela-like W/sr; directional: W/m^2
    float range = 0;                                 // metres; 0: infinite
    float innerCone = 0, outerCone = 0.785398163f;   // radians from the axis
    // Of a point light: texture of its photometric profile, as in restir::Light, with its mean over all
    // directions.
    uint32_t profile = RS_NO_TEXTURE;
    float profileMean = 1;
    glm::quat profileTurn{1, 0, 0, 0};
};

// The environment: what rays that leave the scene see, and a light.
struct Sky {
    FloatImage map;       // equirectangular radiance, finite; no pixels: no sky
    float rotation = 0;   // radians about y: where the map's x axis turns towards -z
    float scale = 1;
};

// Looks from `eye` to `target`. verticalFov in radians.
struct View {
    glm::vec3 eye{0, 0, 4}, target{0}, up{0, 1, 0};
    float verticalFov = 0.8f;
    std::string name = {};
};

// What may change over time. Instances, materials and lights keep their places in SceneData.
struct SceneState {
    std::vector<glm::mat4> worldFromObject = {};   // of each instance; one that mirrors must go on mirroring
    std::vector<float> emission = {};              // factor on each material's; 0: its lights are gone
    std::vector<PunctualLight> punctual = {};      // black: gone
    std::vector<restir::Light> shapes = {};        // black: gone
    float skyRotation = 0;
};

// Turns a scene at rest into that of a time, counted in frames; the last frame of a sequence has time 0. The
// same for the same time, always. Empty: nothing moves.
using Motion = std::function<void(float time, SceneState& state)>;

struct Animation {
    std::string name = {};
    Motion motion = {};
};

struct SceneData {
    std::string name = {};
    std::vector<Image> images = {};
    std::vector<Texture> textures = {};   // RsMaterial's texture indices point here
    std::vector<restir::gpu::RsMaterial> materials = {};
    std::vector<Mesh> meshes = {};
    std::vector<Instance> instances = {};
    std::vector<PunctualLight> punctual = {};
    std::vector<restir::Light> shapes = {};   // lights of other kinds without texture; ids are given later
    Sky sky = {};
    std::vector<View> views = {};             // the scene's cameras; may be empty
    std::vector<Animation> animations = {};   // ways in which it can move
};

SceneState restOf(const SceneData& scene);

// Throws std::runtime_error naming those there are.
Motion findMotion(const SceneData& scene, std::string_view animation);

// .gltf or .glb. Throws std::runtime_error naming the file and what is wrong; `warnings` gets one line per
// extension, primitive kind or feature that was skipped.
SceneData loadGltf(const std::string& path, std::vector<std::string>& warnings);

// "cornell", "market", "street?triangles=2826672&emissive=20658", "lamps?kind=sphere". Throws std::runtime_error on unknown names.
SceneData makeBuiltin(std::string_view name);

// A file, or builtin:NAME.
SceneData loadScene(const std::string& nameOrPath, std::vector<std::string>& warnings);

// A view that frames the whole scene, for scenes without a camera.
View frameScene(const SceneData& scene);

// Every material diffuse with its base colour (specular, metalness, normal maps and alpha off, emission
// kept), to compare with other renderers.
void makeLambert(SceneData& scene);

}   // namespace samples
