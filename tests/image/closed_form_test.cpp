// A rectangle over a diffuse plane, against Lambert's formula; behind a blocker, against the path tracer. The
// sampling unit is a sequence with all its reuse.
#include <gtest/gtest.h>

#include "image/hypothesis.h"
#include "image/stage.h"
#include "image/world.h"

namespace tests {
namespace {

using samples::build::Patch;

constexpr VkExtent2D kExtent{32, 32};
constexpr uint32_t kPictures = 56, kFrames = 10;
constexpr glm::vec3 kRadiance{3, 5, 7};

samples::Sequence sequenceOf(const World& world, uint32_t firstSeed = 0) {
    return {.view = world.view(), .frames = kFrames, .seed = firstSeed, .accumulate = true};
}

// Seeds differ between estimators, or their errors would be the same.
SeedStatistics pictures(World& world, uint32_t estimator, const restir::Settings& settings) {
    SeedStatistics statistics;
    for (uint32_t i = 1; i <= kPictures; ++i) {
        const samples::FloatImage image = world.render(sequenceOf(world, estimator * 1000 + i), settings);
        EXPECT_TRUE(allFinite(image));
        EXPECT_EQ(world.renderer().stats().counters.rejectedWeights, 0u);
        EXPECT_GT(world.renderer().stats().counters.rays, 0u);
        statistics.add(image);
    }
    return statistics;
}

samples::SceneData lampOverPlane() {
    samples::SceneData scene = planeScene();
    addQuad(scene, lamp({0, 1, 0}, 0.5f), {.color = {0, 0, 0}, .emission = kRadiance});
    return scene;
}
samples::FloatImage lampOverPlanePicture(const samples::View& view) {
    return planePicture(view, kExtent, 4, [](glm::dvec3 p) {
        return glm::dvec3(kRadiance) * lampIrradiance(lamp({0, 1, 0}, 0.5f), p);
    });
}

TEST(ClosedForm, RectangleOverPlane) {
    World world(lampOverPlane(), kExtent);
    const ReferenceBlocks truth = exactly(lampOverPlanePicture(world.view()));

    const std::vector<NamedSettings> all = settingsInTheOpen();
    Verdict verdict(all.size() + 1, kPictures);
    for (uint32_t i = 0; i < all.size(); ++i)
        verdict.add(all[i].name, compare(pictures(world, i, all[i].settings), truth));
    verdict.add("reference", compare(world.referenceSeeds(kPictures, sequenceOf(world), {.paths = 4}), truth));
    verdict.expectUnitVariance();
}

TEST(ClosedForm, CheckerboardBlursByAPixelAndNoMore) {
    World world(lampOverPlane(), kExtent);
    const ReferenceBlocks truth = exactly(halfBlurred(lampOverPlanePicture(world.view())));
    const std::vector<NamedSettings> all = checkerboards();
    Verdict verdict(all.size(), kPictures);
    for (uint32_t i = 0; i < all.size(); ++i)
        verdict.add(all[i].name, compare(pictures(world, 200 + i, all[i].settings), truth));
    verdict.expectUnitVariance();
}

// The black half of the lamp takes its half of the light away, in both triangles.
TEST(ClosedForm, HalfBlackTexture) {
    samples::SceneData scene = planeScene();
    const uint32_t texture = samples::build::addTexture(
        scene, samples::build::paint(8, 8, false, [](glm::vec2 at) { return glm::vec4(at.x < 0.5f ? 0 : 1); }));
    scene.textures[texture].nearest = true;
    addQuad(scene, lamp({0, 1, 0}, 0.5f), {.color = {0, 0, 0}, .emission = kRadiance, .emissionTexture = texture});
    World world(std::move(scene), kExtent);
    const Patch bright{.origin = {0, 1, -0.5f}, .u = {0.5f, 0, 0}, .v = {0, 0, 1}};
    const ReferenceBlocks truth = exactly(planePicture(world.view(), kExtent, 4, [&](glm::dvec3 p) {
        return glm::dvec3(kRadiance) * lampIrradiance(bright, p);
    }));

    const std::vector<NamedSettings> all = pairwiseInTheOpen();
    Verdict verdict(all.size() + 1, kPictures);
    for (uint32_t i = 0; i < all.size(); ++i)
        verdict.add("texture " + all[i].name, compare(pictures(world, 100 + i, all[i].settings), truth));
    verdict.add("texture reference", compare(world.referenceSeeds(kPictures, sequenceOf(world), {.paths = 8}), truth));
    verdict.expectUnitVariance();
}

class Occluded : public testing::Test {
protected:
    static void SetUpTestSuite() {
        samples::SceneData scene = planeScene();
        addQuad(scene, lamp({0, 2, 0}, 0.5f), {.color = {0, 0, 0}, .emission = kRadiance});
        addQuad(scene, lamp({0.1f, 0.95f, -0.3f}, 0.3f), {.color = {0.5f, 0.5f, 0.5f}, .specular = 0});
        world = new World(std::move(scene), kExtent);
        truth = new ReferenceBlocks(
            referenceFromSeeds(world->referenceSeeds(kPictures, sequenceOf(*world), {.paths = 64})));
    }
    static void TearDownTestSuite() {
        delete truth;
        delete world;
    }

    static Agreement against(const char* name, uint32_t estimator, const restir::Settings& settings) {
        const Agreement agreement = compare(pictures(*world, estimator, settings), *truth);
        print(name, agreement);
        return agreement;
    }
    // Between `low` and `high` per cent of the truth, and far beyond chance.
    static void expectDarker(const Agreement& a, double low, double high) {
        for (size_t c = 0; c < 3; ++c) {
            EXPECT_GE(-100 * a.channelRatio[c], low);
            EXPECT_LE(-100 * a.channelRatio[c], high);
            EXPECT_GE(-a.channelRatio[c], 8 * a.channelError[c]);
        }
    }

    static World* world;
    static ReferenceBlocks* truth;
};
World* Occluded::world = nullptr;
ReferenceBlocks* Occluded::truth = nullptr;

TEST_F(Occluded, UnbiasedSettingsAgreeWithTheReference) {
    const std::vector<NamedSettings> all = unbiasedSettings();
    Verdict verdict(all.size(), kPictures);
    for (uint32_t i = 0; i < all.size(); ++i)
        verdict.add(all[i].name, compare(pictures(*world, i, all[i].settings), *truth));
    verdict.expectUnitVariance();
}

// In each biased setting some sample that a pixel could not have had counts as one that it might have had.
TEST_F(Occluded, BiasedSettingsAreTooDark) {
    restir::Settings settings = unbiased();
    settings.di.weights = restir::Weights::Off;
    settings.di.visibility = restir::VisibilityReuse::Cached;
    expectDarker(against("off cached", 20, settings), 35, 50);
    settings.di.visibility = restir::VisibilityReuse::Traced;
    expectDarker(against("off traced", 21, settings), 35, 50);
    settings.di.weights = restir::Weights::Pairwise;
    settings.di.visibility = restir::VisibilityReuse::Cached;
    expectDarker(against("pairwise cached", 22, settings), 20, 35);
}

}   // namespace
}   // namespace tests
