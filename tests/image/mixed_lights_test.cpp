// Lights of all kinds in one scene, each with a share of about the same size, against the reference path
// tracer; the triangles, textured, are read by the SDK itself.
#include <gtest/gtest.h>

#include <cmath>

#include "image/hypothesis.h"
#include "image/stage.h"
#include "image/world.h"

namespace tests {
namespace {

using namespace samples::build;
using restir::Light;
using restir::LightKind;
using samples::SceneState;
using samples::Sequence;

constexpr VkExtent2D kExtent{32, 32};
constexpr uint32_t kFrames = 10, kSkip = 3;

enum : uint32_t { kPlane, kPost, kScreen };                // instances
enum : uint32_t { kSphere, kDisk, kPanel, kTube, kSun };   // shapes
enum : uint32_t { kBulb, kSpot };                          // punctual lights

samples::Image screenImage() {
    return paint(8, 8, false, [](glm::vec2 uv) { return glm::vec4(uv.x > 0.5f ? 1 : 0.4f, 0.3f + 0.7f * uv.y, 0.9f - 0.6f * uv.x, 1); });
}

samples::FloatImage skyMap() {
    samples::FloatImage map{8, 4, {}};
    for (uint32_t y = 0; y < 4; ++y)
        for (uint32_t x = 0; x < 8; ++x) {
            const float warm = x < 4 ? 0.45f : 0.25f, bright = x == 2 && y == 1 ? 2.0f : 1.0f;
            map.rgb.insert(map.rgb.end(), {bright * warm, bright * 0.35f, bright * (0.7f - warm)});
        }
    return map;
}

samples::SceneData fair() {
    samples::SceneData scene = planeScene();
    samples::Geometry post{.material = addMaterial(scene, {.color = kAlbedo, .roughness = 1, .specular = 0})};
    addBox(post, {-0.05f, 0, -0.05f}, {0.05f, 0.2f, 0.05f});
    addInstance(scene, addMesh(scene, {post}), place({0.1f, 0, 0.1f}));
    samples::Geometry screen{.material =
                                 addMaterial(scene, {.color = {0, 0, 0},
                                                     .emission = glm::vec3(24),
                                                     .specular = 0,
                                                     .emissionTexture = addTexture(scene, screenImage())})};
    addPatch(screen, lamp({0, 0, 0}, 0.15f));
    addInstance(scene, addMesh(scene, {screen}), place({-0.5f, 0.7f, -0.2f}));
    scene.shapes = {{.kind = LightKind::Sphere,
                     .position = {0.5f, 0.5f, -0.3f},
                     .radius = 0.1f,
                     .emission = {24, 20, 14}},
                    {.kind = LightKind::Disk,
                     .position = {0, 0.7f, -0.5f},
                     .direction = {0, -1, 0.3f},
                     .radius = 0.15f,
                     .emission = {12, 15, 18}},
                    {.kind = LightKind::Rectangle,
                     .position = {-0.35f, 0.5f, 0.2f},
                     .vertex1 = {-0.05f, 0.5f, 0.2f},
                     .vertex2 = {-0.35f, 0.5f, 0.4f},
                     .emission = {10, 8, 10}},
                    {.kind = LightKind::Capsule,
                     .position = {0.1f, 0.5f, 0.3f},
                     .vertex1 = {0.6f, 0.55f, 0.2f},
                     .radius = 0.03f,
                     .emission = {15, 15, 11}},
                    {.kind = LightKind::Directional,
                     .direction = {0.4f, -1, 0.3f},
                     .angularRadius = 0.08f,
                     .emission = {1.2f, 1, 0.8f}}};
    scene.punctual = {
        {.kind = samples::PunctualKind::Point, .position = {-0.4f, 0.6f, 0.4f}, .intensity = {0.8f, 1, 0.9f}},
        {.kind = samples::PunctualKind::Spot,
         .position = {0.4f, 0.8f, 0.4f},
         .direction = glm::normalize(glm::vec3(-0.4f, -0.8f, -0.4f)),
         .intensity = {1.2f, 1, 0.8f},
         .innerCone = 0.2f,
         .outerCone = 0.7f}};
    scene.sky.map = skyMap();
    return scene;
}

// Each drifts its own way, some grow and pulse, the screen turns, the sky too.
void moveAll(float time, SceneState& state) {
    const auto wave = [=](float phase) { return std::sin(0.9f * time + phase); };
    state.worldFromObject[kScreen] =
        place({-0.5f + 0.06f * wave(0), 0.7f, -0.2f}, 0.4f * wave(1), 1 + 0.3f * wave(2));
    state.worldFromObject[kPost] = place({0.1f + 0.02f * time, 0, 0.1f}, 0.1f * time);
    state.emission[2] = 1 + 0.4f * wave(3);
    for (Light& light : state.shapes) {
        const float phase = light.position[0] * 7 + light.radius;
        for (float(*at)[3] : {&light.position, &light.vertex1, &light.vertex2}) {
            (*at)[0] += 0.05f * wave(phase);
            (*at)[2] += 0.04f * wave(phase + 2);
        }
        light.radius *= 1 + 0.3f * wave(phase + 1);
    }
    state.shapes[kSun].direction[0] += 0.15f * wave(4);
    state.shapes[kSun].angularRadius *= 1 + 0.2f * wave(5);
    if (std::lround(time) % 3 == 0) state.shapes[kTube].emission[1] = 0.5f;
    state.punctual[kBulb].position.x += 0.1f * wave(1);
    state.punctual[kSpot].direction = glm::normalize(glm::vec3(-0.4f + 0.2f * wave(2), -0.8f, -0.4f));
    state.skyRotation = 0.2f * time;
}

class MixedLights : public testing::Test {
protected:
    static World& world() {
        static World world(fair(), kExtent, {.emitters = samples::Emitters::Meshes});
        return world;
    }
    static void expectUnbiased(const char* name, const samples::Motion& motion, uint32_t pictures,
                               uint32_t references, uint32_t paths) {
        const Sequence sequence{.view = world().view(),
                                .frames = kFrames,
                                .accumulate = true,
                                .skip = kSkip,
                                .jitter = false,
                                .orbitDegrees = motion ? 1.0f : 0.0f,
                                .motion = motion};
        restir::Settings settings = unbiased();
        settings.di.radius = 6;   // keeps blocks apart, and the cap frames
        settings.di.maxHistory = 4;
        settings.di.lightCandidates = 16;
        const ReferenceBlocks truth =
            referenceFromSeeds(world().referenceSeeds(references, sequence, {.paths = paths}));
        Verdict verdict(1, pictures);
        verdict.add(name, compare(world().seeds(pictures, sequence, settings), truth));
    }
};
class LongMixedLights : public MixedLights {};

TEST_F(MixedLights, Moving) { expectUnbiased("all kinds, moving", moveAll, 48, 24, 24); }
TEST_F(LongMixedLights, Standing) { expectUnbiased("all kinds, standing, long", {}, 384, 96, 32); }
TEST_F(LongMixedLights, Moving) { expectUnbiased("all kinds, moving, long", moveAll, 384, 96, 32); }

}   // namespace
}   // namespace tests
