#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include <glm/gtc/matrix_transform.hpp>

#include "builtin.h"
#include "market.h"

namespace samples::build {

namespace market {

void addGround(SceneData& scene, const Materials& m) {
    constexpr float kMetresPerTile = 5;
    const float length = kNearEnd - kFarEnd, road = 2 * (kHalfStreet - kPavement);
    Parts parts;
    addPatch(parts.of(m.cobbles), {.origin = {-road / 2, 0, kNearEnd},
                                   .u = {road, 0, 0},
                                   .v = {0, 0, -length},
                                   .columns = 4,
                                   .rows = 32,
                                   .uvScale = {road / kMetresPerTile, length / kMetresPerTile}});
    constexpr float kSlab = 0.9f;
    for (const float side : {-1.0f, 1.0f})
        for (uint32_t slab = 0; slab < static_cast<uint32_t>(length / kSlab); ++slab) {
            const float z = kNearEnd - kSlab * static_cast<float>(slab);
            const float inner = side * (kHalfStreet - kPavement), outer = side * (kHalfStreet + 0.3f);
            const float joint = 0.012f, x0 = std::min(inner, outer), x1 = std::max(inner, outer);
            const float kerb = side > 0 ? x0 + 0.22f : x1 - 0.22f;
            addBox(parts.of(m.paving), {x0, -0.1f, z - kSlab + joint}, {kerb - joint, kKerb, z});
            addBox(parts.of(m.paving), {kerb, -0.1f, z - kSlab + joint}, {x1, kKerb, z});
        }
    addInstance(scene, parts.addTo(scene));
}

// Closes the street: walls with a gate, a clock tower, and two spots that light it from below.
void addTower(SceneData& scene, const Materials& m) {
    Parts parts;
    constexpr float kHalf = 2.4f, kHeight = 14, kFront = kFarEnd, kBack = kFarEnd - 5;
    addBox(parts.of(m.walls[3]), {-kHalf, 0, kBack}, {kHalf, kHeight, kFront});
    for (const float y : {6.2f, 8.4f, kHeight - 0.3f})
        addBox(parts.of(m.trim), {-kHalf - 0.15f, y, kBack}, {kHalf + 0.15f, y + 0.3f, kFront + 0.2f});
    addBox(parts.of(m.walls[4]), {-kHalfStreet - 6, 0, kBack}, {-kHalf, 6, kFront - 0.6f});
    addBox(parts.of(m.walls[4]), {kHalf, 0, kBack}, {kHalfStreet + 6, 6, kFront - 0.6f});
    addPatch(parts.of(m.gate), {.origin = {-1.2f, 0, kFront + 0.02f},
                                .u = {2.4f, 0, 0},
                                .v = {0, 3.6f, 0},
                                .columns = 3,
                                .rows = 4});
    addPatch(parts.of(m.clock), {.origin = {-1.3f, 9.6f, kFront + 0.03f},
                                 .u = {2.6f, 0, 0},
                                 .v = {0, 2.6f, 0},
                                 .columns = 4,
                                 .rows = 4});
    const glm::vec3 top{0, kHeight + 4.5f, (kFront + kBack) / 2};
    const std::array<glm::vec3, 4> eaves = {{{-kHalf - 0.3f, kHeight, kFront + 0.3f},
                                             {kHalf + 0.3f, kHeight, kFront + 0.3f},
                                             {kHalf + 0.3f, kHeight, kBack - 0.3f},
                                             {-kHalf - 0.3f, kHeight, kBack - 0.3f}}};
    for (size_t i = 0; i < eaves.size(); ++i)
        addTriangle(parts.of(m.roof), {eaves[i], eaves[(i + 1) % 4], top});
    addInstance(scene, parts.addTo(scene));
    for (const float side : {-1.0f, 1.0f}) {
        const glm::vec3 position{side * 3.2f, 0.5f, kFront + 4.5f}, aim{side * 0.8f, 10.5f, kFront};
        scene.punctual.push_back({.kind = PunctualKind::Spot,
                                  .position = position,
                                  .direction = glm::normalize(aim - position),
                                  .intensity = side < 0 ? glm::vec3{160, 120, 80} : glm::vec3{70, 90, 160},
                                  .innerCone = 0.18f,
                                  .outerCone = 0.4f});
    }
}

namespace {

void addHouses(SceneData& scene, const Materials& m) {
    Rng rng(41);
    uint32_t sign = 6;   // puts RESTIR where the first view reads it
    for (const bool left : {true, false}) {
        float along = kNearEnd;
        while (along > kFarEnd + 1) {
            const float width = std::min(rng.range(5.2f, 7.4f), along - kFarEnd);
            if (width < 4) break;
            const House house{
                .width = width, .floors = 2 + rng.below(3), .seed = rng.below(100000), .sign = sign++ % 8};
            const float x = kHalfStreet + rng.range(0, 0.12f);
            const uint32_t mesh = makeHouse(scene, m, house);
            const glm::vec3 corner = left ? glm::vec3{-x, 0, along} : glm::vec3{x, 0, along - width};
            addInstance(scene, mesh, place(corner, left ? kPi / 2 : -kPi / 2));
            along -= width;
        }
    }
}

}   // namespace

// Instances of meshes with a geometry of one of these materials.
std::vector<uint32_t> instancesWith(const SceneData& scene, std::span<const uint32_t> materials) {
    std::vector<uint32_t> found;
    for (uint32_t i = 0; i < scene.instances.size(); ++i) {
        const auto& geometries = scene.meshes[scene.instances[i].mesh].geometries;
        const auto has = [&](const Geometry& geometry) {
            return std::find(materials.begin(), materials.end(), geometry.material) != materials.end();
        };
        if (std::any_of(geometries.begin(), geometries.end(), has)) found.push_back(i);
    }
    return found;
}

// About an axis along the street through `hook`, in the instance's own space.
void swing(glm::mat4& worldFromObject, float hook, float angle) {
    const glm::vec3 world{worldFromObject * glm::vec4{0, hook, 0, 1}};
    const glm::mat4 turn = glm::rotate(glm::mat4{1}, angle, glm::vec3{0, 0, 1});
    worldFromObject = place(world) * turn * place(-world) * worldFromObject;
}

// A breeze goes down the street: bulbs and lanterns swing, two signs blink, the lamps flicker, and a potted
// shrub is pushed across the pavement.
Motion breeze(const SceneData& scene, const Materials& m) {
    const std::vector<uint32_t> bulbs = instancesWith(scene, m.bulbs),
                                lanterns = instancesWith(scene, m.lanterns);
    const uint32_t shrub = instancesWith(scene, std::array{m.pot}).front();
    const std::array<uint32_t, 2> signs = {m.signs[6], m.signs[1]};
    const uint32_t lamp = m.lamp;
    return [=](float time, SceneState& state) {
        const auto wind = [&](uint32_t instance) {
            const glm::vec4& at = state.worldFromObject[instance][3];
            return std::sin(0.25f * time + 0.6f * at.z + 0.35f * at.x);
        };
        for (const uint32_t i : bulbs) swing(state.worldFromObject[i], 0, 0.5f * wind(i));
        for (const uint32_t i : lanterns) swing(state.worldFromObject[i], 0.32f, 0.3f * wind(i));
        for (size_t i = 0; i < signs.size(); ++i) {
            const int step = static_cast<int>(std::floor(time / 7)) + static_cast<int>(i);
            state.emission[signs[i]] = step % 2 == 0 ? 1.0f : 0.0f;
        }
        state.emission[lamp] = 1 + 0.15f * std::sin(1.7f * time) * std::sin(0.31f * time);
        state.worldFromObject[shrub][3].x += 0.5f * (1 - std::cos(0.08f * time));
    };
}

}   // namespace market

SceneData makeMarket() {
    SceneData scene{.name = "market"};
    const market::Materials materials = market::makeMaterials(scene);
    market::addGround(scene, materials);
    market::addHouses(scene, materials);
    market::addTower(scene, materials);
    market::addStalls(scene, materials);
    market::addStreetLamps(scene, materials);
    market::addStringLights(scene, materials);
    market::addClutter(scene, materials);
    scene.views = {
        {.eye = {0.35f, 1.62f, 16.2f}, .target = {-0.15f, 2.35f, 2}, .verticalFov = 0.86f, .name = "market"},
        {.eye = {0.9f, 1.5f, 6.4f}, .target = {-2.6f, 1.2f, 2.7f}, .verticalFov = 0.8f, .name = "stall"},
        {.eye = {-3.2f, 6.4f, 16.5f}, .target = {0.8f, 2, 0}, .verticalFov = 0.9f, .name = "balcony"}};
    scene.animations = {{"breeze", market::breeze(scene, materials)}};
    return scene;
}

}   // namespace samples::build
