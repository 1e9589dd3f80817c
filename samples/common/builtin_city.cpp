#include <array>
#include <cmath>

#include "builtin.h"
#include "mesh_builder.h"

namespace samples::build {

namespace {

// Metres. A square kilometre of towers, one in each block, every window lit, and lamps along the streets.
constexpr uint32_t kBlocks = 16, kTowerKinds = 16, kColumns = 14, kLampsPerBlock = 4;
constexpr float kBlock = 62.5f, kHalf = kBlock * kBlocks / 2, kTower = 36, kFloor = 3.5f;
constexpr std::array<uint32_t, 6> kLightColors = {0xffc27a, 0xffd9a0, 0xfff1d6, 0xdfeaff, 0x9fc4ff, 0xff9a5e};

uint32_t floorsOf(uint32_t kind) { return 21 + 2 * kind; }

// Windows of one tower, by colour; its foot is the origin.
std::vector<Geometry> makeWindows(uint32_t kind, const std::vector<uint32_t>& materials) {
    std::vector<Geometry> windows;
    for (const uint32_t material : materials) windows.push_back({.material = material});
    const float pitch = kTower / kColumns;
    for (uint32_t side = 0; side < 4; ++side) {
        const glm::mat3 turn(place({}, static_cast<float>(side) * kPi / 2));
        for (uint32_t i = 0; i < floorsOf(kind) * kColumns; ++i) {
            const float x = (static_cast<float>(i % kColumns) + 0.2f) * pitch - kTower / 2;
            const float y = (static_cast<float>(i / kColumns) + 0.3f) * kFloor;
            const uint32_t choice =
                hash(i + 7919 * side + 104729 * kind) % static_cast<uint32_t>(windows.size());
            addPatch(windows[choice], {.origin = turn * glm::vec3{x, y, kTower / 2 + 0.05f},
                                       .u = turn * glm::vec3{0.6f * pitch, 0, 0},
                                       .v = {0, 0.5f * kFloor, 0}});
        }
    }
    return windows;
}

void addTowers(SceneData& scene) {
    std::vector<uint32_t> lights;
    for (uint32_t i = 0; i < 2 * kLightColors.size(); ++i)   // bright ones and dim ones
        lights.push_back(addMaterial(
            scene, {.color = glm::vec3{0.2f}, .emission = hex(kLightColors[i / 2]) * (i % 2 ? 6.0f : 0.8f)}));
    const uint32_t wall = addMaterial(scene, {.color = hex(0x8c8780), .roughness = 0.6f});
    std::vector<uint32_t> towers;
    for (uint32_t kind = 0; kind < kTowerKinds; ++kind) {
        std::vector<Geometry> geometries = makeWindows(kind, lights);
        Geometry walls{.material = wall};
        addBox(walls, {-kTower / 2, 0, -kTower / 2},
               {kTower / 2, static_cast<float>(floorsOf(kind)) * kFloor + 1, kTower / 2});
        geometries.push_back(std::move(walls));
        towers.push_back(addMesh(scene, std::move(geometries)));
    }
    for (uint32_t i = 0; i < kBlocks * kBlocks; ++i) {
        const glm::vec3 at{(static_cast<float>(i % kBlocks) + 0.5f) * kBlock - kHalf, 0,
                           (static_cast<float>(i / kBlocks) + 0.5f) * kBlock - kHalf};
        addInstance(scene, towers[i * 5 % kTowerKinds],
                    place(at));   // each kind as often, so that the number of lights is known
    }
}

void addStreets(SceneData& scene) {
    const uint32_t asphalt = addMaterial(scene, {.color = hex(0x55555a), .roughness = 0.45f});
    Geometry ground{.material = asphalt};
    addPatch(ground, {.origin = {-kHalf, 0, kHalf},
                      .u = {2 * kHalf, 0, 0},
                      .v = {0, 0, -2 * kHalf},
                      .columns = 64,
                      .rows = 64});
    addInstance(scene, addMesh(scene, {std::move(ground)}));
    Geometry lamps{.material =
                       addMaterial(scene, {.color = glm::vec3{0.2f}, .emission = hex(0xffb45e) * 250.0f})};
    for (uint32_t i = 0; i < kBlocks * kBlocks * kLampsPerBlock; ++i) {
        const uint32_t block = i / kLampsPerBlock, lamp = i % kLampsPerBlock;
        const glm::vec3 corner{static_cast<float>(block % kBlocks) * kBlock - kHalf, 6,
                               static_cast<float>(block / kBlocks) * kBlock - kHalf};
        const float along = (static_cast<float>(lamp / 2) + 0.5f) * kBlock / 2;
        addOctahedron(lamps, corner + (lamp % 2 ? glm::vec3{along, 0, 7} : glm::vec3{7, 0, along}), 0.2f);
    }
    addInstance(scene, addMesh(scene, {std::move(lamps)}));
}

}   // namespace

SceneData makeCity() {
    SceneData scene{.name = "city"};
    addTowers(scene);
    addStreets(scene);
    scene.views = {{.eye = {4, 1.7f, 30}, .target = {0, 14, -60}, .verticalFov = 1.0f, .name = "street"},
                   {.eye = {0, 150, 330}, .target = {0, 40, 0}, .verticalFov = 0.9f, .name = "above"}};
    return scene;
}

}   // namespace samples::build
