// The reference against itself: next-event estimation combined with BSDF sampling, and BSDF sampling alone,
// which knows nothing of lights. One large emitter, so that chance finds it.
#include <gtest/gtest.h>

#include "image/hypothesis.h"
#include "image/stage.h"
#include "image/world.h"

namespace tests {
namespace {

constexpr VkExtent2D kExtent{32, 32};
constexpr uint32_t kPictures = 16, kPaths = 32;
constexpr glm::vec3 kRadiance{3, 5, 7};

// Emission of a lamp whose texture is black on one half.
uint32_t halfBlack(samples::SceneData& scene) {
    return samples::build::addTexture(scene, samples::build::paint(16, 16, true, [](glm::vec2 uv) {
                                          return uv.x < 0.5f ? glm::vec4(0, 0, 0, 1)
                                                             : glm::vec4(1, 0.5f, 0.25f, 1);
                                      }));
}

// Rough and glossy, dielectric and metal under a lamp; closed in, so that light goes on.
samples::SceneData room(uint32_t bulbs) {
    samples::SceneData scene = planeScene();
    const samples::build::Patch back{{-2, 0, -1}, {4, 0, 0}, {0, 3, 0}};
    addQuad(scene, back, {.color = {0.9f, 0.6f, 0.3f}, .roughness = 0.2f, .metalness = 1});
    const samples::build::Patch side{{-1, 0, 2}, {0, 0, -4}, {0, 3, 0}};
    addQuad(scene, side, {.color = {0.2f, 0.7f, 0.4f}, .roughness = 0.3f});
    addQuad(scene, lamp({0, 1.5f, 0}, 1), {.emission = kRadiance, .emissionTexture = halfBlack(scene)});
    for (uint32_t i = 0; i < bulbs; ++i) {
        const glm::vec3 place(0.1f * static_cast<float>(i) - 0.5f, 1, 0.4f);
        addQuad(scene, lamp(place, 0.04f), {.emission = 4.0f * kRadiance, .doubleSided = true});
    }
    return scene;
}

// The last instance in a mirror through its middle: its light must not turn to the other side.
void mirrorLast(samples::SceneData& scene) {
    glm::mat4 mirror(1.0f);
    mirror[0][0] = -1;
    scene.instances.back().worldFromObject = mirror;
}

double meanLuminance(const samples::SceneData& scene) {
    World world(scene, kExtent);
    SeedStatistics statistics;
    statistics.add(
        world.reference({.view = world.view(), .frames = 4, .accumulate = true}, {.paths = kPaths}));
    return luminance(statistics.channelMean());
}

void expectAgreement(samples::SceneData scene, uint32_t bounces) {
    World world(std::move(scene), kExtent);
    const samples::Sequence sequence{.view = world.view(), .frames = 4, .accumulate = true};
    const samples::ReferenceSettings combined{.paths = kPaths, .bounces = bounces};
    const samples::ReferenceSettings alone{.paths = 2 * kPaths, .bounces = bounces, .nextEvent = false};
    const ReferenceBlocks truth = referenceFromSeeds(world.referenceSeeds(kPictures, sequence, combined));
    SeedStatistics statistics;
    for (uint32_t i = 0; i < kPictures; ++i) {
        samples::Sequence other = sequence;
        other.seed = 1000 + i;
        statistics.add(world.reference(other, alone));
    }
    Verdict verdict(1, kPictures);
    verdict.add("BSDF sampling alone", compare(statistics, truth));
}

TEST(Reference, DirectLight) { expectAgreement(room(0), 1); }
TEST(Reference, SeveralBounces) { expectAgreement(room(0), 4); }
TEST(Reference, ManyLights) { expectAgreement(room(10), 2); }

TEST(Reference, MirroredEmitter) {
    samples::SceneData scene = room(0);
    const double before = meanLuminance(scene);
    mirrorLast(scene);
    EXPECT_GT(meanLuminance(scene), 0.5 * before);
    expectAgreement(std::move(scene), 1);
}

}   // namespace
}   // namespace tests
