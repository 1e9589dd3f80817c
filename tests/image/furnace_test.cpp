// The white furnace: inside a closed box that shines everywhere, a white surface looks like the box.
#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "image/hypothesis.h"
#include "image/stage.h"
#include "image/world.h"

namespace tests {
namespace {

using namespace samples::build;

constexpr VkExtent2D kExtent{32, 32};
constexpr uint32_t kPictures = 40, kFrames = 6;
constexpr float kRoughness = 128.0f / 255.0f;   // as surfaces are packed

// Walls inside out.
void addFurnace(samples::SceneData& scene) {
    samples::Geometry walls{.material = addMaterial(scene, {.color = {0, 0, 0}, .specular = 0})};
    scene.materials[walls.material].emission = {1, 1, 1};
    addBox(walls, glm::vec3(-2), glm::vec3(2));
    for (size_t i = 0; i < walls.indices.size(); i += 3) std::swap(walls.indices[i], walls.indices[i + 1]);
    for (glm::vec3& normal : walls.normals) normal = -normal;
    addInstance(scene, addMesh(scene, {walls}));
}

// Three faces of a cube fill the picture: convex and flat, each point sees nothing but walls.
World furnace(const Surface& white) {
    samples::SceneData scene;
    addFurnace(scene);
    samples::Geometry cube{.material = addMaterial(scene, white)};
    addBox(cube, glm::rotate(glm::mat4(1), 0.3f, glm::vec3(0, 0, 1)), glm::vec3(-0.5f), glm::vec3(0.5f));
    addInstance(scene, addMesh(scene, {cube}));
    scene.views.push_back({.eye = {1.1f, 1.4f, 1.5f}, .target = {0.3f, 0.5f, 0.45f}, .verticalFov = 0.25f});
    return World(std::move(scene), kExtent);
}

samples::FloatImage white() {
    return {kExtent.width, kExtent.height, std::vector<float>(3 * kExtent.width * kExtent.height, 1.0f)};
}

SeedStatistics pictures(World& world, uint32_t estimator, restir::Settings settings) {
    SeedStatistics statistics;
    settings.di.lightCandidates = 32;
    for (uint32_t i = 1; i <= kPictures; ++i) {
        statistics.add(world.render(
            {.view = world.view(), .frames = kFrames, .seed = estimator * 1000 + i, .accumulate = true}, settings));
        EXPECT_EQ(world.renderer().stats().counters.rejectedWeights, 0u);
    }
    return statistics;
}

TEST(Furnace, WhiteDiffuseVanishes) {
    World world = furnace({.color = {1, 1, 1}, .roughness = 1, .specular = 0});
    const std::vector<NamedSettings> all = settingsInTheOpen();
    Verdict verdict(all.size(), kPictures);
    for (uint32_t i = 0; i < all.size(); ++i)
        verdict.add("furnace " + all[i].name, compare(pictures(world, i, all[i].settings), exactly(white())));
    verdict.expectUnitVariance();
}

// A single-scattering microfacet metal loses what bounces between its facets, and gains nothing.
TEST(Furnace, RoughMetalLosesAsMuchAsTheReference) {
    World world = furnace({.color = {1, 1, 1}, .roughness = kRoughness, .metalness = 1});
    const samples::Sequence sequence{.view = world.view(), .frames = kFrames, .accumulate = true};
    const ReferenceBlocks truth = referenceFromSeeds(world.referenceSeeds(kPictures, sequence, {.paths = 24}));
    const std::vector<NamedSettings> all = pairwiseInTheOpen();
    Verdict verdict(all.size(), kPictures);
    for (uint32_t i = 0; i < all.size(); ++i) {
        const SeedStatistics metal = pictures(world, i, all[i].settings);
        verdict.add("metal " + all[i].name, compare(metal, truth));
        const double bound = studentBound(all.size() * metal.blocks(), kPictures);
        for (size_t block = 0; block < metal.blocks(); ++block)
            EXPECT_LE(metal.blockMean(block) - bound * std::sqrt(metal.blockVariance(block)), 1.0) << all[i].name;
    }
    verdict.expectUnitVariance();
}

}   // namespace
}   // namespace tests
