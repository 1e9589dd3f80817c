// The lamps of builtin:lamps: a place, an aim and a power that any kind of light can have.
#pragma once

#include <cstdint>

#include "mesh_builder.h"

namespace samples::build {

enum class LampKind : uint8_t {
    Triangle,
    Textured,   // a square of two triangles
    Sphere,
    Disk,
    Rectangle,
    Capsule,
    Point,
    Spot,
    Profile,   // points and spots in turns, with a photometric profile
};
constexpr uint32_t kLampKinds = 9;

// Of any kind: seen along its aim pi size^2 large and as bright as `radiance`, or with the intensity of that.
struct Lamp {
    glm::vec3 position, aim;   // the latter of any length
    float spin;                // radians about the aim
    float size;                // metres
    glm::vec3 radiance;
};

// What of a scene is a lamp.
struct Fitting {
    LampKind kind;
    uint32_t index;      // in the scene's instances, shapes or punctual lights
    uint32_t material;   // of an instance
};
Fitting addLamp(SceneData& scene, LampKind kind, const Lamp& lamp);
// `rest` is the lamp that was added.
void setLamp(SceneState& state, const Fitting& fitting, const Lamp& rest, const Lamp& lamp);

}   // namespace samples::build
