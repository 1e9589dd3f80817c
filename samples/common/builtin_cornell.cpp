#include <array>
#include <cmath>

#include "builtin.h"
#include "mesh_builder.h"

namespace samples::build {

namespace {

// Metres. The room's floor is y = 0, the camera looks along -z from inside.
constexpr float kHalfWidth = 1.4f, kHeight = 2.6f, kBack = -1.4f, kFront = 2.2f;
constexpr uint32_t kTriangleCount = 100, kColorCount = 10;

struct Block {
    glm::vec3 centre, halfSize;
    float turn;

    // Conservative: the block's bounding cylinder, a margin wide.
    bool near(const glm::vec3& point, float margin) const {
        const float radius = glm::length(glm::vec2{halfSize.x, halfSize.z}) + margin;
        const glm::vec2 offset{point.x - centre.x, point.z - centre.z};
        return glm::dot(offset, offset) < radius * radius && point.y < centre.y + halfSize.y + margin;
    }
};

constexpr Block kTall{{-0.5f, 0.75f, -0.6f}, {0.36f, 0.75f, 0.36f}, 0.32f};
constexpr Block kShort{{0.52f, 0.38f, 0.3f}, {0.38f, 0.38f, 0.38f}, -0.3f};

// Each wall faces inward and blocks light both ways.
void addRoom(SceneData& scene) {
    const uint32_t white =
        addMaterial(scene, {.color = {0.73f, 0.71f, 0.68f}, .roughness = 1, .specular = 0.5f});
    const uint32_t red =
        addMaterial(scene, {.color = {0.61f, 0.06f, 0.05f}, .roughness = 1, .specular = 0.5f});
    const uint32_t green =
        addMaterial(scene, {.color = {0.11f, 0.43f, 0.09f}, .roughness = 1, .specular = 0.5f});
    const glm::vec3 x{2 * kHalfWidth, 0, 0}, y{0, kHeight, 0}, z{0, 0, kFront - kBack};
    const glm::vec3 corner{-kHalfWidth, 0, kBack};
    Geometry whiteWalls{.material = white}, left{.material = red}, right{.material = green};
    addPatch(whiteWalls, {.origin = corner + z, .u = x, .v = -z});
    addPatch(whiteWalls, {.origin = corner + y, .u = x, .v = z});
    addPatch(whiteWalls, {.origin = corner, .u = x, .v = y});
    addPatch(whiteWalls, {.origin = corner + x + z, .u = -x, .v = y});
    addPatch(left, {.origin = corner + z, .u = -z, .v = y});
    addPatch(right, {.origin = corner + x, .u = z, .v = y});
    addInstance(scene, addMesh(scene, {whiteWalls, left, right}));
}

void addBlock(SceneData& scene, const Block& block, const Surface& surface) {
    Geometry geometry{.material = addMaterial(scene, surface)};
    addBox(geometry, -block.halfSize, block.halfSize);
    addInstance(scene, addMesh(scene, {geometry}), place(block.centre, block.turn));
}

glm::vec3 floatingPoint(Rng& rng) {
    constexpr float kMargin = 0.2f, kCameraSpace = 1.3f;
    for (;;) {
        const glm::vec3 point{rng.range(kMargin - kHalfWidth, kHalfWidth - kMargin),
                              rng.range(kMargin, kHeight - kMargin),
                              rng.range(kBack + kMargin, kFront - kCameraSpace)};
        if (!kTall.near(point, kMargin) && !kShort.near(point, kMargin)) return point;
    }
}

std::array<glm::vec3, 3> triangleAround(Rng& rng, const glm::vec3& centre) {
    const glm::vec3 normal = rng.direction();
    const glm::vec3 u = glm::normalize(glm::cross(normal, glm::vec3{normal.y, -normal.z, normal.x + 0.1f}));
    const glm::vec3 v = glm::cross(normal, u);
    const float size = rng.range(0.04f, 0.09f);
    const auto at = [&](float angle) { return centre + size * (u * std::cos(angle) + v * std::sin(angle)); };
    return {at(0), at(2 * kPi / 3), at(4 * kPi / 3)};
}

// Half of the colours emit from one side only, so that both kinds of light occur.
void addLights(SceneData& scene) {
    constexpr std::array<uint32_t, kColorCount> kColors = {0xffb45a, 0x5aa0ff, 0xff5a78, 0x6effb4, 0xffe6b4,
                                                           0xb46eff, 0xff8232, 0x46e6ff, 0xfffae6, 0xe65aff};
    Rng rng(7);
    for (uint32_t color = 0; color < kColorCount; ++color) {
        Geometry geometry{.material = addMaterial(scene, {.color = glm::vec3{0.1f},
                                                          .roughness = 1,
                                                          .emission = hex(kColors[color]) * rng.range(8, 28),
                                                          .specular = 0.5f,
                                                          .doubleSided = color % 2 == 0})};
        for (uint32_t i = 0; i < kTriangleCount / kColorCount; ++i)
            addTriangle(geometry, triangleAround(rng, floatingPoint(rng)));
        addInstance(scene, addMesh(scene, {std::move(geometry)}));
    }
}

// Instances, in the order in which makeCornell adds them, and the first of the lights' materials.
enum : uint32_t { kRoom, kTallBlock, kShortBlock, kFirstLight };
constexpr uint32_t kFirstLightMaterial = 5;

// Each colour drifts about, turns and swells, by up to 4 cm a frame: less than the 20 cm that everything
// keeps from everything else.
void moveLights(float time, SceneState& state) {
    for (uint32_t color = 0; color < kColorCount; ++color) {
        const float phase = 0.7f * time + 2.1f * static_cast<float>(color);
        const glm::vec3 drift = 0.06f * glm::vec3{std::sin(phase), std::cos(phase), std::sin(2 * phase)};
        const glm::vec3 centre{0, kHeight / 2, 0};
        state.worldFromObject[kFirstLight + color] =
            place(centre + drift, 0.03f * std::sin(phase), 1 + 0.04f * std::cos(phase)) * place(-centre);
    }
}

// Every three frames another third of the colours is off; the others pulse.
void switchLights(float time, SceneState& state) {
    const int step = static_cast<int>(std::floor(time / 3));
    for (uint32_t color = 0; color < kColorCount; ++color) {
        const bool off = (step + static_cast<int>(color) + 3000) % 3 == 0;
        const float pulse = 1 + 0.5f * std::sin(1.3f * time + static_cast<float>(color));
        state.emission[kFirstLightMaterial + color] = off ? 0.0f : pulse;
    }
}

// The tall block slides and turns, the short one hops.
void moveBlocks(float time, SceneState& state) {
    const glm::vec3 slide{0.12f * std::sin(0.5f * time), 0, 0};
    const glm::vec3 hop{0, 0.1f * std::abs(std::sin(0.4f * time)), 0};
    state.worldFromObject[kTallBlock] =
        place(kTall.centre + slide, kTall.turn + 0.1f * std::sin(0.7f * time));
    state.worldFromObject[kShortBlock] = place(kShort.centre + hop, kShort.turn);
}

}   // namespace

SceneData makeCornell() {
    SceneData scene{.name = "cornell"};
    addRoom(scene);
    addBlock(scene, kTall, {.color = {0.91f, 0.84f, 0.72f}, .roughness = 0.3f, .metalness = 1});
    addBlock(scene, kShort, {.color = {0.7f, 0.7f, 0.72f}, .roughness = 1, .specular = 0.5f});
    addLights(scene);
    scene.views.push_back(
        {.eye = {0, 1.3f, kFront - 0.05f}, .target = {0, 1.2f, 0}, .verticalFov = 1.0f, .name = "room"});
    scene.animations = {{"lights", moveLights}, {"switching", switchLights}, {"objects", moveBlocks}};
    return scene;
}

}   // namespace samples::build
