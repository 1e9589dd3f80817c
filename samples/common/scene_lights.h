// The lights of a scene, for the SDK and for the reference.
#pragma once

#include <vector>

#include <restir/lights.h>

#include "common/scene.h"

namespace samples {

// Kinds in reference_lights.glsl, whose struct this is.
enum class ReferenceKind : uint32_t { Triangle, Local, Directional, Capsule, Rectangle, Disk, Sky };
struct ReferenceLight {
    ReferenceKind kind = ReferenceKind::Triangle;
    uint32_t record = 0, primitive = 0;
    glm::vec3 position{0}, direction{0, 0, -1}, intensity{0};
    float range = 0, coneScale = 0, coneOffset = 1, radius = 0;
    glm::vec3 edge1{0}, edge2{0};
    uint32_t twoSided = 0;
    uint32_t profile = RS_NO_TEXTURE;   // of a local light, in axes of which edge1 is x and edge2 is z
};

// Where a light comes from.
struct LightSource {
    enum class Kind : uint8_t { Triangle, Punctual, Shape, Sky };
    Kind kind = Kind::Triangle;
    uint32_t from = 0;           // triangle: its instance; punctual, shape: which one
    uint32_t material = 0;       // of a triangle
    glm::vec3 corners[3] = {};   // of a triangle, in object space
};

struct SceneLights {
    std::vector<restir::Light> lights;   // black and degenerate triangles are left out; their ids stay free
    std::vector<ReferenceLight> reference;   // the same lights in the same order
    std::vector<LightSource> sources;        // likewise
    std::vector<uint32_t> firstLight;        // of each (instance, geometry) record; RS_NO_LIGHT
    std::vector<restir::LightMesh> meshes;   // the records that emit
    uint32_t meshLights = 0;                 // ids of triangles are below, all others from there on
    uint32_t idCount = 0;                    // one more than the largest id
    uint64_t emissiveTriangles = 0;          // triangles of emissive materials
};

// Records count geometries, instance by instance. Throws std::runtime_error beyond the SDK's limit.
SceneLights makeSceneLights(const SceneData& scene);

// The lights that shine when the scene is in `state`, with ids from `firstId` on; ids as at rest.
std::vector<restir::Light> lightsAt(const SceneLights& rest, const SceneState& state, uint32_t firstId = 0);
// All lights in that state, black ones too.
std::vector<ReferenceLight> referenceAt(const SceneLights& rest, const SceneState& state);

}   // namespace samples
