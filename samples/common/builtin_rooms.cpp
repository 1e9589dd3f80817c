#include <cmath>

#include "builtin.h"
#include "mesh_builder.h"

namespace samples::build {

namespace {

// Metres. A bright room behind a wall (z < 0), and the dark one that the camera is in, with a door between them.
constexpr float kHalfWidth = 2.4f, kHeight = 2.7f, kBack = -3.5f, kFront = 4.5f, kWall = 0.12f;
constexpr float kDoorLeft = -0.5f, kDoorRight = 0.5f, kDoorHeight = 2.1f;

// Floor, ceiling and outer walls, seen from inside.
void addShell(SceneData& scene) {
    Geometry walls{.material = addMaterial(scene, {.color = {0.76f, 0.73f, 0.68f}, .roughness = 0.9f})};
    Geometry floor{.material = addMaterial(scene, {.color = {0.42f, 0.27f, 0.16f}, .roughness = 0.35f})};
    Geometry red{.material = addMaterial(scene, {.color = {0.62f, 0.2f, 0.13f}, .roughness = 0.9f})};
    const glm::vec3 x{2 * kHalfWidth, 0, 0}, y{0, kHeight, 0}, z{0, 0, kFront - kBack};
    const glm::vec3 corner{-kHalfWidth, 0, kBack};
    addPatch(floor, {.origin = corner + z, .u = x, .v = -z});
    addPatch(walls, {.origin = corner + y, .u = x, .v = z});
    addPatch(walls, {.origin = corner, .u = x, .v = y});
    addPatch(walls, {.origin = corner + x + z, .u = -x, .v = y});
    addPatch(red, {.origin = corner + z, .u = -z, .v = y});
    addPatch(walls, {.origin = corner + x, .u = z, .v = y});
    // The wall between the rooms, around the doorway.
    addBox(walls, {-kHalfWidth, 0, -kWall}, {kDoorLeft, kHeight, 0});
    addBox(walls, {kDoorRight, 0, -kWall}, {kHalfWidth, kHeight, 0});
    addBox(walls, {kDoorLeft, kDoorHeight, -kWall}, {kDoorRight, kHeight, 0});
    addInstance(scene, addMesh(scene, {walls, floor, red}));
}

// Hinged at its left edge, which is its origin; open towards the dark room by so many radians.
glm::mat4 doorAt(float angle) { return place({kDoorLeft, 0, -0.01f}, -angle); }
void addDoor(SceneData& scene) {
    Geometry leaf{.material = addMaterial(scene, {.color = {0.5f, 0.52f, 0.5f}, .roughness = 0.6f})};
    addBox(leaf, {0, 0.005f, -0.05f}, {kDoorRight - kDoorLeft - 0.005f, kDoorHeight - 0.005f, 0});
    Geometry knob{.material = addMaterial(scene, {.color = {0.9f, 0.7f, 0.35f}, .roughness = 0.25f, .metalness = 1})};
    addSphere(knob, {kDoorRight - kDoorLeft - 0.09f, 1, 0.04f}, glm::vec3{0.035f}, 16, 8);
    addInstance(scene, addMesh(scene, {leaf, knob}), doorAt(1.6f));
}

void addFurniture(SceneData& scene) {
    Geometry wood{.material = addMaterial(scene, {.color = {0.3f, 0.18f, 0.1f}, .roughness = 0.4f})};
    addBox(wood, {-1.9f, 0.7f, 1.2f}, {-0.9f, 0.76f, 2.4f});
    for (float leg : {1.25f, 2.3f})
        for (float side : {-1.85f, -1.0f}) addBox(wood, {side, 0, leg}, {side + 0.06f, 0.7f, leg + 0.06f});
    addBox(wood, {1.7f, 0, 0.15f}, {2.35f, 1.9f, 0.75f});
    Geometry steel{.material = addMaterial(scene, {.color = {0.8f, 0.82f, 0.85f}, .roughness = 0.2f, .metalness = 1})};
    addSphere(steel, {-1.35f, 0.94f, 1.75f}, glm::vec3{0.18f}, 32, 16);
    Geometry cloth{.material = addMaterial(scene, {.color = {0.15f, 0.3f, 0.55f}, .roughness = 1})};
    addBox(cloth, {0.9f, 0, 1.6f}, {1.7f, 0.45f, 2.4f});
    addInstance(scene, addMesh(scene, {wood, steel, cloth}));
}

constexpr uint32_t kDoor = 1;   // of the instances

// Both shine downwards. Returns the ceiling lamp's material.
uint32_t addLamps(SceneData& scene) {
    Geometry ceiling{.material = addMaterial(scene, {.color = glm::vec3{0}, .emission = glm::vec3{24, 21.5f, 18}, .specular = 0})};
    addPatch(ceiling, {.origin = {-0.6f, kHeight - 0.02f, -2.0f}, .u = {1.2f, 0, 0}, .v = {0, 0, 0.6f}});
    Geometry reading{.material = addMaterial(scene, {.color = glm::vec3{0}, .emission = glm::vec3{150, 95, 45}, .specular = 0})};
    addPatch(reading, {.origin = {1.9f, 1.7f, 3.2f}, .u = {0.15f, 0, 0}, .v = {0, 0, 0.15f}});
    const uint32_t material = ceiling.material;
    addInstance(scene, addMesh(scene, {ceiling, reading}));
    return material;
}

// To and fro; at time 0 half open, and turning by 6 degrees a frame.
void turnDoor(float time, SceneState& state) {
    state.worldFromObject[kDoor] = doorAt(0.8f * (1 + std::sin(2 * kPi * time / 48)));
}

}   // namespace

SceneData makeRooms() {
    SceneData scene{.name = "rooms"};
    addShell(scene);
    addDoor(scene);
    addFurniture(scene);
    const uint32_t lamp = addLamps(scene);
    scene.views = {{.eye = {0.9f, 1.5f, 4.3f}, .target = {-0.2f, 1.05f, 0}, .verticalFov = 1.0f, .name = "dark"},
                   {.eye = {-2, 1.6f, -3.2f}, .target = {0.3f, 1, 0}, .verticalFov = 1.0f, .name = "bright"}};
    // On and off in turns of 24 frames; at time 0 it is dark for the third frame.
    const auto switchLamp = [lamp](float time, SceneState& state) {
        const float cycle = std::fmod(time + 2 + 4800, 48.0f);
        state.emission[lamp] = cycle < 24 ? 0.0f : 1.0f;
    };
    scene.animations = {{"door", turnDoor}, {"switch", switchLamp}};
    return scene;
}

}   // namespace samples::build
