// samples/own_bridge: passes compiled with a host's own surfaces, materials and scene set.
#include <gtest/gtest.h>

#include <own_bridge/host.h>

#include "image/hypothesis.h"
#include "image/stage.h"
#include "image/world.h"

namespace tests {
namespace {

constexpr VkExtent2D kExtent{32, 32};
constexpr glm::vec3 kRadiance{3, 5, 7};

class OwnBridge : public testing::Test {
protected:
    OwnBridge() {
        samples::SceneData data = planeScene();
        addQuad(data, lamp({0, 1, 0}, 0.5f), {.color = {0, 0, 0}, .emission = kRadiance});
        view = data.views[0];
        paints = own_bridge::paintsOf(data);
        scene = std::make_unique<samples::GpuScene>(device(), std::move(data));
        makeHost();
    }
    void makeHost(restir::RayBackend rays = device().bestRays()) {
        host = std::make_unique<own_bridge::Host>(device(), *scene, paints, kExtent, rays);
    }
    samples::FloatImage picture(uint32_t seed, own_bridge::Host::Target target = own_bridge::Host::Radiance) {
        for (uint32_t i = 0; i < 4; ++i) host->frame(view, i, seed, unbiased(), i == 0);
        return host->read(target);
    }

    samples::View view;
    std::vector<own_bridge::Paint> paints;
    std::unique_ptr<samples::GpuScene> scene;
    std::unique_ptr<own_bridge::Host> host;
};

// A paint without its retroreflective part is Lambert's.
TEST_F(OwnBridge, PaintOverPlaneIsItsClosedForm) {
    SeedStatistics statistics;
    for (uint32_t seed = 1; seed <= 96; ++seed) statistics.add(picture(seed));
    const ReferenceBlocks truth = exactly(planePicture(view, kExtent, 1, [](glm::dvec3 p) {
        return glm::dvec3(kRadiance) * lampIrradiance(lamp({0, 1, 0}, 0.5f), p);
    }));
    Verdict verdict(1, 96);
    verdict.add("own bridge", compare(statistics, truth));
}

// The bridge in ray generation and any-hit shaders, and set 1 bound for them.
TEST_F(OwnBridge, PipelinesGiveTheSamePicture) {
    const samples::FloatImage expected = picture(1);
    EXPECT_GT(largest(expected), 0.1f);
    makeHost(restir::RayBackend::Pipeline);
    EXPECT_EQ(picture(1).rgb, expected.rgb);
}

// A BSDF without RS_BRIDGE_LOBES: all is in one lobe, over a factor of 1.
TEST_F(OwnBridge, WithoutLobesDiffuseHasAll) {
    paints[0].retro = 4;
    makeHost();
    const samples::FloatImage radiance = picture(1), diffuse = host->read(own_bridge::Host::Diffuse);
    EXPECT_GT(largest(radiance), 0.1f);
    EXPECT_LE(largestDifference(diffuse, radiance), 1e-5);
    EXPECT_EQ(largest(host->read(own_bridge::Host::Specular)), 0);
    // Preset Fast fills every other pixel from these lobes.
    host->frame(view, 0, 1, {.di = restir::presetSettings(restir::Preset::Fast)}, true);
    EXPECT_TRUE(allFinite(host->read(own_bridge::Host::Radiance)));
    EXPECT_LE(
        largestDifference(host->read(own_bridge::Host::Diffuse), host->read(own_bridge::Host::Radiance)),
        1e-5);
}

}   // namespace
}   // namespace tests
