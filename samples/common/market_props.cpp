#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

#include "market.h"

namespace samples::build::market {

namespace {

// From an underside at y = -0.24 to a hook at y = 0.3.
uint32_t makeLantern(SceneData& scene, const Materials& m, uint32_t color) {
    Parts parts;
    constexpr float kRadius = 0.2f, kHalf = 0.22f;
    addSphere(parts.of(m.lanterns[color]), glm::vec3{0}, {kRadius, kHalf, kRadius}, 10, 6);
    constexpr std::array<glm::vec2, 4> kCap = {
        {{0.09f, 0.17f}, {0.09f, 0.23f}, {0.012f, 0.24f}, {0.012f, 0.32f}}};
    addLathe(parts.of(m.darkWood), glm::vec3{0}, kCap, 8);
    constexpr std::array<glm::vec2, 4> kFoot = {{{0, -0.24f}, {0.07f, -0.24f}, {0.07f, -0.19f}, {0, -0.19f}}};
    addLathe(parts.of(m.darkWood), glm::vec3{0}, kFoot, 8);
    return parts.addTo(scene);
}

void addCrateBoards(Geometry& wood) {
    constexpr float kX = 0.26f, kZ = 0.19f, kHigh = 0.17f, kBoard = 0.015f;
    addBox(wood, {-kX, 0, -kZ}, {kX, kBoard, kZ});
    for (const float y : {0.02f, 0.1f}) {
        const float top = y + 0.065f;
        addBox(wood, {-kX, y, -kZ}, {kX, top, kBoard - kZ});
        addBox(wood, {-kX, y, kZ - kBoard}, {kX, top, kZ});
        addBox(wood, {-kX, y, -kZ}, {kBoard - kX, top, kZ});
        addBox(wood, {kX - kBoard, y, -kZ}, {kX, top, kZ});
    }
    for (const float x : {-kX + kBoard, kX - 2.5f * kBoard})
        for (const float z : {-kZ + kBoard, kZ - 2.5f * kBoard})
            addBox(wood, {x, 0, z}, {x + 1.5f * kBoard, kHigh, z + 1.5f * kBoard});
}

uint32_t makeFruitCrate(SceneData& scene, const Materials& m, uint32_t fruit) {
    Parts parts;
    addCrateBoards(parts.of(m.wood));
    Rng rng(300 + fruit);
    constexpr uint32_t kColumns = 5, kRows = 3;
    for (uint32_t layer = 0; layer < 2; ++layer)
        for (uint32_t i = 0; i < (layer ? 8 : kColumns * kRows); ++i) {
            const uint32_t columns = layer ? kColumns - 1 : kColumns;
            const float x = (static_cast<float>(i % columns) - static_cast<float>(columns - 1) / 2) * 0.096f;
            const uint32_t row = i / columns;
            const float z = (static_cast<float>(row) - (layer ? 0.5f : 1.0f)) * 0.108f;
            const glm::vec3 centre{x + rng.range(-0.008f, 0.008f), 0.12f + 0.075f * static_cast<float>(layer),
                                   z};
            const glm::vec3 radii = glm::vec3{0.048f, 0.045f, 0.048f} * rng.range(0.9f, 1.08f);
            addSphere(parts.of(m.fruits[fruit]), centre, radii, 8, 5);
        }
    return parts.addTo(scene);
}

// A table with a cloth, four posts and a sloped canopy; customers stand at +z.
uint32_t makeStall(SceneData& scene, const Materials& m, uint32_t awning) {
    Parts parts;
    constexpr float kX = 1.1f, kZ = 0.5f, kTable = 0.82f, kBackTop = 2.55f, kFrontTop = 2.2f, kHem = 0.2f;
    addBox(parts.of(m.wood), {-kX, kTable - 0.05f, -kZ}, {kX, kTable, kZ});
    addBox(parts.of(m.darkWood), {-kX + 0.05f, 0.1f, -kZ + 0.05f}, {kX - 0.05f, kTable - 0.05f, -kZ + 0.08f});
    addPatch(parts.of(awning % 2 ? m.cloth : m.awnings[awning]), {.origin = {-kX, 0.12f, kZ + 0.01f},
                                                                  .u = {2 * kX, 0, 0},
                                                                  .v = {0, kTable - 0.12f, 0},
                                                                  .uvScale = {1.5f, 1}});
    for (const float x : {-kX, kX - 0.06f}) {
        addBox(parts.of(m.darkWood), {x, 0, -kZ}, {x + 0.06f, kBackTop, -kZ + 0.06f});
        addBox(parts.of(m.darkWood), {x, 0, kZ - 0.06f}, {x + 0.06f, kFrontTop + 0.08f, kZ});
    }
    Geometry& canopy = parts.of(m.awnings[awning]);
    const glm::vec3 width{2 * kX + 0.3f, 0, 0}, front{-kX - 0.15f, kFrontTop, kZ + 0.35f};
    const glm::vec3 slope = glm::vec3{0, kBackTop, -kZ - 0.15f} - glm::vec3{0, front.y, front.z};
    addPatch(canopy,
             {.origin = front, .u = width, .v = slope, .columns = 8, .rows = 4, .uvScale = {1.6f, 1}});
    addPatch(canopy,
             {.origin = front - glm::vec3{0, kHem, 0}, .u = width, .v = {0, kHem, 0}, .uvScale = {1.6f, 1}});
    return parts.addTo(scene);
}

uint32_t makeBarrel(SceneData& scene, const Materials& m) {
    Parts parts;
    constexpr std::array<glm::vec2, 7> kStaves = {
        {{0, 0}, {0.24f, 0}, {0.29f, 0.22f}, {0.31f, 0.42f}, {0.29f, 0.62f}, {0.25f, 0.84f}, {0, 0.84f}}};
    addLathe(parts.of(m.darkWood), glm::vec3{0}, kStaves, 20);
    for (const float y : {0.15f, 0.62f}) {
        const std::array<glm::vec2, 4> hoop = {
            {{0.28f, y}, {0.303f, y}, {0.305f, y + 0.06f}, {0.28f, y + 0.06f}}};
        addLathe(parts.of(m.iron), glm::vec3{0}, hoop, 20);
    }
    return parts.addTo(scene);
}

uint32_t makeShrub(SceneData& scene, const Materials& m, uint32_t seed) {
    Parts parts;
    constexpr std::array<glm::vec2, 6> kPot = {
        {{0, 0}, {0.19f, 0}, {0.27f, 0.42f}, {0.3f, 0.42f}, {0.3f, 0.48f}, {0, 0.46f}}};
    addLathe(parts.of(m.pot), glm::vec3{0}, kPot, 16);
    Rng rng(seed);
    for (uint32_t i = 0; i < 90; ++i) {
        const glm::vec3 outward = rng.direction();
        const glm::vec3 centre =
            glm::vec3{0, 0.95f, 0} + outward * glm::vec3{0.36f, 0.5f, 0.36f} * rng.range(0.5f, 1.0f);
        addCard(parts.of(i % 9 == seed % 9 ? m.flowers : m.foliage), rng, centre, outward,
                rng.range(0.2f, 0.3f));
    }
    return parts.addTo(scene);
}

uint32_t makeStreetLamp(SceneData& scene, const Materials& m) {
    Parts parts;
    constexpr std::array<glm::vec2, 9> kPole = {{{0.17f, 0},
                                                 {0.17f, 0.25f},
                                                 {0.1f, 0.4f},
                                                 {0.075f, 0.9f},
                                                 {0.1f, 0.95f},
                                                 {0.055f, 1.05f},
                                                 {0.045f, 3.1f},
                                                 {0.11f, 3.2f},
                                                 {0.13f, 3.24f}}};
    addLathe(parts.of(m.iron), glm::vec3{0}, kPole, 14);
    addSphere(parts.of(m.lamp), {0, 3.43f, 0}, {0.19f, 0.21f, 0.19f}, 12, 7);
    constexpr std::array<glm::vec2, 5> kHat = {
        {{0.21f, 3.56f}, {0.21f, 3.6f}, {0.07f, 3.72f}, {0.02f, 3.76f}, {0, 3.85f}}};
    addLathe(parts.of(m.iron), glm::vec3{0}, kHat, 14);
    constexpr uint32_t kStays = 4;
    for (uint32_t i = 0; i < kStays; ++i) {
        const float angle = 2 * kPi * static_cast<float>(i) / kStays;
        const glm::vec3 out{std::cos(angle), 0, std::sin(angle)};
        const std::array<glm::vec3, 3> path = {0.13f * out + glm::vec3{0, 3.22f, 0},
                                               0.22f * out + glm::vec3{0, 3.42f, 0},
                                               0.2f * out + glm::vec3{0, 3.58f, 0}};
        addTube(parts.of(m.iron), path, 0.012f, 6);
    }
    return parts.addTo(scene);
}

struct StallSpot {
    float z;
    bool left;
};

}   // namespace

void addStalls(SceneData& scene, const Materials& m) {
    constexpr std::array<StallSpot, 13> kSpots = {{{11.6f, true},
                                                   {8.3f, false},
                                                   {7.2f, true},
                                                   {4.6f, false},
                                                   {2.6f, true},
                                                   {-0.6f, false},
                                                   {-2.8f, true},
                                                   {-6.0f, false},
                                                   {-8.6f, true},
                                                   {-12.5f, false},
                                                   {-15.0f, true},
                                                   {-20.0f, false},
                                                   {-23.5f, true}}};
    std::vector<uint32_t> stalls, crates, lanterns;
    for (uint32_t i = 0; i < m.awnings.size(); ++i) stalls.push_back(makeStall(scene, m, i));
    for (uint32_t i = 0; i < m.fruits.size(); ++i) crates.push_back(makeFruitCrate(scene, m, i));
    for (uint32_t i = 0; i < m.lanterns.size(); ++i) lanterns.push_back(makeLantern(scene, m, i));
    Rng rng(17);
    for (uint32_t s = 0; s < kSpots.size(); ++s) {
        const float x = kHalfStreet - kPavement - 0.75f, turn = rng.range(-0.08f, 0.08f);
        const glm::vec3 spot{kSpots[s].left ? -x : x, 0, kSpots[s].z};
        const glm::mat4 stall = place(spot, (kSpots[s].left ? 0.5f : -0.5f) * kPi + turn);
        addInstance(scene, stalls[(s + s / 4) % stalls.size()], stall);
        for (uint32_t i = 0; i < 4; ++i) {
            const glm::mat4 tilt = glm::rotate(glm::mat4{1}, 0.2f, glm::vec3{1, 0, 0});
            const glm::vec3 at{0.53f * (static_cast<float>(i) - 1.5f), 0.87f, 0.22f};
            addInstance(scene, crates[rng.below(5)], stall * place(at, rng.range(-0.06f, 0.06f)) * tilt);
            if (i % 2 == s % 2)
                addInstance(scene, crates[rng.below(5)], stall * place(at + glm::vec3{0, 0.06f, -0.45f}));
        }
        for (const float side : {-0.55f, 0.55f})
            addInstance(scene, lanterns[(s + (side > 0 ? 1 : 0)) % lanterns.size()],
                        stall * place({side, 1.83f - rng.range(0, 0.12f), 0.35f}, rng.range(0, 3)));
    }
}

void addStreetLamps(SceneData& scene, const Materials& m) {
    const uint32_t lamp = makeStreetLamp(scene, m);
    for (uint32_t i = 0; i < 10; ++i) {
        const float x = kHalfStreet - 0.85f;
        addInstance(scene, lamp, place({i % 2 ? x : -x, kKerb, 9.6f - 5.2f * static_cast<float>(i)}));
    }
}

void addStringLights(SceneData& scene, const Materials& m) {
    constexpr uint32_t kStrings = 17, kBulbsPerString = 18;
    std::vector<uint32_t> bulbs;
    for (const uint32_t color : m.bulbs) {
        Parts bulb;
        addSphere(bulb.of(color), {0, -0.085f, 0}, {0.042f, 0.05f, 0.042f}, 4, 2);
        constexpr std::array<glm::vec2, 3> kSocket = {{{0.022f, -0.05f}, {0.022f, 0}, {0, 0.01f}}};
        addLathe(bulb.of(m.iron), glm::vec3{0}, kSocket, 6);
        bulbs.push_back(bulb.addTo(scene));
    }
    Parts wires;
    Rng rng(23);
    for (uint32_t s = 0; s < kStrings; ++s) {
        const float z = 13.2f - 3.1f * static_cast<float>(s), slant = s % 2 ? 1.5f : -1.5f;
        const glm::vec3 a{-kHalfStreet, rng.range(4.7f, 5.9f), z + slant},
            b{kHalfStreet, rng.range(4.7f, 5.9f), z - slant};
        const std::vector<glm::vec3> wire = hangingWire(a, b, rng.range(0.6f, 0.95f), kBulbsPerString + 1);
        addTube(wires.of(m.iron), wire, 0.009f, 4);
        // A string has one colour or is a medley of all.
        const bool medley = rng.uniform() < 0.45f;
        const uint32_t own = rng.below(3);
        for (uint32_t i = 1; i <= kBulbsPerString; ++i)
            addInstance(scene, bulbs[medley ? rng.below(6) : own], place(wire[i], rng.range(0, 2)));
    }
    addInstance(scene, wires.addTo(scene));
}

void addClutter(SceneData& scene, const Materials& m) {
    const uint32_t barrel = makeBarrel(scene, m);
    const std::array<uint32_t, 2> shrubs = {makeShrub(scene, m, 3), makeShrub(scene, m, 8)};
    Parts crate;
    addCrateBoards(crate.of(m.wood));
    const uint32_t empty = crate.addTo(scene);
    Rng rng(29);
    for (uint32_t i = 0; i < 12; ++i) {
        const float x = (i % 2 ? 1.0f : -1.0f) * (kHalfStreet - 0.5f),
                    z = 12.4f - 4.1f * static_cast<float>(i);
        addInstance(scene, shrubs[i % 3 == 0],
                    place({x, kKerb, z}, rng.range(0, 6), rng.range(0.85f, 1.15f)));
    }
    for (uint32_t i = 0; i < 8; ++i) {
        const float side = i % 2 ? -1.0f : 1.0f, x = side * 2.3f, z = 9.9f - 4.6f * static_cast<float>(i);
        addInstance(scene, barrel, place({x + rng.range(-0.3f, 0.3f), 0, z}, rng.range(0, 6)));
        for (uint32_t layer = 0; layer < 2 + i % 2; ++layer)
            addInstance(
                scene, empty,
                place({-x * 1.05f, 0.175f * static_cast<float>(layer), z + 0.4f}, rng.range(-0.3f, 0.3f)));
    }
}

}   // namespace samples::build::market
