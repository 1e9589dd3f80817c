// What moves: the camera, objects, lights; lights that switch; jitter. The mean over the later frames of a
// sequence must be that of the reference, which renders the same frames one by one and remembers nothing.
#include <gtest/gtest.h>

#include <cmath>
#include <span>

#include "image/hypothesis.h"
#include "image/stage.h"
#include "image/world.h"

namespace tests {
namespace {

using namespace samples::build;
using samples::Motion;
using samples::SceneState;
using samples::Sequence;

constexpr VkExtent2D kExtent{32, 32};
constexpr uint32_t kPictures = 96, kReferencePictures = 24, kPaths = 16;
constexpr uint32_t kFrames = 12, kSkip = 4;

// Instances of the yard after the plane, in order; their materials go with them.
enum : uint32_t { kPlane, kPost, kSlats, kFirstLamp };
constexpr uint32_t kLamps = 6;

glm::vec3 lampPlace(uint32_t i) {
    const float angle = 1.1f * static_cast<float>(i);
    return {0.5f * std::cos(angle), 0.55f + 0.05f * static_cast<float>(i), 0.45f * std::sin(angle) - 0.2f};
}

// The plane under six small lamps and a bulb, a fence of slats between them that throws stripes, and a post.
samples::SceneData yard() {
    samples::SceneData scene = planeScene();
    samples::Geometry post{.material = addMaterial(scene, {.color = kAlbedo, .roughness = 1, .specular = 0})};
    addBox(post, {-0.06f, 0, -0.06f}, {0.06f, 0.22f, 0.06f});
    addInstance(scene, addMesh(scene, {post}), place({0.1f, 0, 0.1f}));
    samples::Geometry slats{.material =
                                addMaterial(scene, {.color = {0, 0, 0}, .roughness = 1, .specular = 0})};
    for (int i = -4; i <= 4; ++i) {
        const float x = 0.14f * static_cast<float>(i);
        addBox(slats, {x - 0.03f, 0.4f, -0.6f}, {x + 0.03f, 0.41f, 0.4f});
    }
    addInstance(scene, addMesh(scene, {slats}));
    for (uint32_t i = 0; i < kLamps; ++i) {
        samples::Geometry quad{
            .material = addMaterial(scene, {.color = {0, 0, 0}, .emission = glm::vec3(7), .specular = 0})};
        addPatch(quad, lamp({0, 0, 0}, 0.06f));
        addInstance(scene, addMesh(scene, {quad}), place(lampPlace(i)));
    }
    scene.punctual.push_back({.position = {-0.3f, 0.7f, 0.1f}, .intensity = glm::vec3(0.03f)});
    return scene;
}

// Each lamp drifts and turns, its area up to doubles or halves from frame to frame; the bulb swings and
// pulses.
void moveLamps(float time, SceneState& state) {
    for (uint32_t i = 0; i < kLamps; ++i) {
        const float phase = 0.9f * time + static_cast<float>(i);
        const glm::vec3 drift{0.08f * std::sin(phase), 0.03f * std::cos(phase),
                              0.06f * std::sin(0.7f * phase)};
        const float size = 1 + 0.4f * std::cos(1.3f * phase);
        state.worldFromObject[kFirstLamp + i] = place(lampPlace(i) + drift, 0.4f * std::sin(phase), size);
    }
    state.punctual[0].position.x += 0.15f * std::sin(time);
    state.punctual[0].intensity *= 1 + 0.5f * std::sin(1.1f * time);
}

// A third of the lamps is off, another third every two frames, the others pulse; the bulb is off every third
// frame.
void switchLamps(float time, SceneState& state) {
    const int frame = static_cast<int>(std::lround(time)) + 3000;
    for (uint32_t i = 0; i < kLamps; ++i)
        state.emission[kFirstLamp + i] =
            (frame / 2 + static_cast<int>(i)) % 3 == 0 ? 0.0f : 1 + 0.3f * std::sin(time + float(i));
    if (frame % 3 == 0) state.punctual[0].intensity = glm::vec3(0);
}

// Stripes wander, the post walks.
void moveObjects(float time, SceneState& state) {
    state.worldFromObject[kSlats] = place({0.045f * time, 0.01f * std::sin(time), 0});
    state.worldFromObject[kPost] = place({0.1f + 0.02f * time, 0, 0.1f + 0.015f * time}, 0.1f * time);
}

void moveAll(float time, SceneState& state) {
    moveLamps(time, state);
    switchLamps(time, state);
    moveObjects(time, state);
}

restir::Settings settings() {
    restir::Settings s = unbiased();
    s.di.radius = 6;   // keeps blocks apart, and the cap frames
    s.di.maxHistory = 5;
    return s;
}

class Moving : public testing::Test {
protected:
    static World& world() {
        static World world(yard(), kExtent);
        return world;
    }
    static Sequence sequence(const Motion& motion) {
        return {.view = world().view(),
                .frames = kFrames,
                .accumulate = true,
                .skip = kSkip,
                .jitter = false,
                .motion = motion};
    }
    static ReferenceBlocks truth(const Sequence& sequence) {
        return referenceFromSeeds(world().referenceSeeds(kReferencePictures, sequence, {.paths = kPaths}));
    }
    static Sequence everything() {
        Sequence s = sequence(moveAll);
        s.orbitDegrees = 1;
        s.jitter = true;
        return s;
    }
    static const ReferenceBlocks& movingObjects() {
        static const ReferenceBlocks reference = truth(sequence(moveObjects));
        return reference;
    }
    static void expectUnbiased(const char* name, const Sequence& sequence, const ReferenceBlocks& reference,
                               World& by = world()) {
        Verdict verdict(1, kPictures);
        verdict.add(name, compare(by.seeds(kPictures, sequence, settings()), reference));
    }
    static void expectUnbiased(const char* name, const Sequence& sequence) {
        expectUnbiased(name, sequence, truth(sequence));
    }
};

// Camera, lamps and objects each alone are LongMoving's, together EverythingAtOnce's.
TEST_F(Moving, SwitchingLights) { expectUnbiased("switching lights", sequence(switchLamps)); }

// The software backend keeps what its instances were itself.
TEST_F(Moving, ObjectsInBvh) {
    World software(yard(), kExtent, {.rays = restir::RayBackend::Software});
    expectUnbiased("moving objects, software", sequence(moveObjects), movingObjects(), software);
}

// Last frame's visibility in this frame's scene: what has just come out of the shadow stays too dark, nothing
// is too bright.
TEST_F(Moving, ObjectsWithoutPreviousTlas) {
    Sequence s = sequence(moveObjects);
    s.previousTlas = false;
    const Agreement a = compare(world().seeds(12, s, settings()), movingObjects());
    print("moving objects, no previous structure", a);
    for (size_t c = 0; c < 3; ++c) {
        EXPECT_LT(a.channelRatio[c], -0.42);
        EXPECT_GT(a.channelRatio[c], -0.46);
    }
}

// What a host with everything turned on does, under each weights and visibility that is called unbiased.
class LongMoving : public Moving {};

struct Estimator {
    const char* name;
    restir::Weights weights;
    restir::VisibilityReuse visibility;
};

void expectAllUnbiased(std::span<const Estimator> estimators, uint32_t pictures, World& world, Sequence s,
                       const ReferenceBlocks& reference) {
    Verdict verdict(estimators.size(), pictures);
    for (const Estimator& estimator : estimators) {
        restir::Settings chosen = settings();
        chosen.di.weights = estimator.weights;
        chosen.di.visibility = estimator.visibility;
        verdict.add(estimator.name, compare(world.seeds(pictures, s, chosen), reference));
    }
    verdict.expectUnitVariance();
}

using enum restir::Weights;
using enum restir::VisibilityReuse;

TEST_F(Moving, EverythingAtOnce) {
    constexpr Estimator kQuiet[] = {{"all moves: pairwise traced", Pairwise, Traced},
                                    {"all moves: pairwise none", Pairwise, None}};
    expectAllUnbiased(kQuiet, kPictures, world(), everything(), truth(everything()));
}

// Three times the precision.
TEST_F(LongMoving, EachAlone) {
    constexpr uint32_t kMany = 8 * kPictures;
    Sequence camera = sequence({});
    camera.orbitDegrees = 2;
    camera.jitter = true;
    const std::pair<const char*, Sequence> all[] = {{"moving objects, long", sequence(moveObjects)},
                                                    {"switching lights, long", sequence(switchLamps)},
                                                    {"moving lights, long", sequence(moveLamps)},
                                                    {"moving camera, long", camera}};
    Verdict verdict(std::size(all), kMany);
    for (const auto& [name, s] : all) {
        const ReferenceBlocks reference =
            referenceFromSeeds(world().referenceSeeds(kMany, s, {.paths = kPaths / 2}));
        verdict.add(name, compare(world().seeds(kMany, s, settings()), reference));
    }
    verdict.expectUnitVariance();
}

TEST_F(LongMoving, EverythingAtOnce) {
    constexpr Estimator kNoisy[] = {{"all moves: basic traced", Basic, Traced},
                                    {"all moves: basic none", Basic, None},
                                    {"all moves: balance traced", Balance, Traced},
                                    {"all moves: balance none", Balance, None}};
    expectAllUnbiased(kNoisy, 8 * kPictures, world(), everything(), truth(everything()));
}

}   // namespace
}   // namespace tests
