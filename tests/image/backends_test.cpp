// Pictures by the software ray backend against those by ray query: seed by seed, and as estimators of the
// same light.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <optional>

#include <common/ray_lists.h>
#include <common/scene.h>
#include <common/scene_options.h>

#include "image/hypothesis.h"
#include "image/world.h"

namespace tests {
namespace {

constexpr VkExtent2D kExtent{32, 32};
constexpr uint32_t kPictures = 32, kFrames = 4;

// Direct and indirect light with all reuse.
restir::Settings everything() {
    restir::Settings settings = unbiased();
    settings.di.radius = 6;
    settings.di.maxHistory = 4;
    settings.gi.mode = restir::IndirectMode::Restir;
    settings.gi.radius = 6;
    settings.gi.maxHistory = 4;
    return settings;
}

World& world(restir::RayBackend rays) {
    static std::map<restir::RayBackend, std::unique_ptr<World>> worlds;
    std::unique_ptr<World>& found = worlds[rays];
    if (!found)
        found = std::make_unique<World>(samples::makeBuiltin("cornell"), kExtent, samples::LightingDesc{.rays = rays});
    return *found;
}

samples::Sequence sequence(const char* animation) {
    const samples::SceneData data = samples::makeBuiltin("cornell");
    samples::Sequence result{.view = data.views[0], .frames = kFrames, .accumulate = true};
    if (*animation) result.motion = samples::findMotion(data, animation);
    return result;
}

// The same random numbers meet the same triangles, but for rays that graze an edge; one other choice spreads over
// neighbours and frames. `render` makes the picture by a backend.
void expectSamePictures(const char* name, size_t others,
                        const std::function<samples::FloatImage(restir::RayBackend)>& render) {
    const samples::FloatImage expected = render(device().bestRays());
    for (const samples::RayBackendName& rays : samples::rayBackends()) {
        if (rays.backend == device().bestRays() || !device().has(rays.backend)) continue;
        const size_t other = otherPixels(render(rays.backend), expected);
        std::printf("%s, %s: %zu of %zu pixels differ\n", name, rays.name, other, expected.rgb.size() / 3);
        EXPECT_LE(other, others);
    }
}

class Backends : public testing::TestWithParam<const char*> {};

TEST_P(Backends, SameSeedSamePicture) {
    samples::Sequence s = sequence(GetParam());
    s.seed = 3;
    expectSamePictures(GetParam(), 20, [&](restir::RayBackend rays) { return world(rays).render(s, everything()); });
}

// Foliage and the like: any-hit shaders, and the walk through the tree, ask the bridge.
TEST(AlphaTested, SameSeedSamePicture) {
    const samples::SceneData data = samples::makeBuiltin("market");
    const samples::Sequence s{.view = data.views[0], .frames = 2, .seed = 5, .accumulate = true};
    expectSamePictures("market", 51, [&](restir::RayBackend rays) {
        return World(data, kExtent, {.rays = rays}).render(s, everything());
    });
}

// Independent seeds, means against means.
TEST_P(Backends, SameLight) {
    samples::Sequence s = sequence(GetParam());
    SeedStatistics hardware, software;
    for (s.seed = 1; s.seed <= kPictures; ++s.seed)
        hardware.add(world(device().bestRays()).render(s, everything()));
    for (; s.seed <= 2 * kPictures; ++s.seed)
        software.add(world(restir::RayBackend::Software).render(s, everything()));
    const Agreement a = compare(software, referenceFromSeeds(hardware));
    print(GetParam(), a);
    EXPECT_LE(a.worstZ, studentBound(a.blocks, kPictures));
    for (size_t c = 0; c < 3; ++c) {
        EXPECT_LE(std::abs(a.channelRatio[c]), studentBound(3, kPictures) * a.channelError[c]);
        EXPECT_LE(a.channelError[c], 0.015);   // seed by seed says more
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, Backends, testing::Values("", "objects"),
                         [](const auto& tested) { return std::string(*tested.param ? "Moving" : "Static"); });

// Rays that see the scene, that go on from there, and shadow rays.
void expectAgreement(const char* name, samples::SceneData data, VkExtent2D extent) {
    const samples::View view = data.views.empty() ? samples::frameScene(data) : data.views[0];
    size_t masked = 0;
    for (const auto& material : data.materials) masked += material.flags & RS_MATERIAL_ALPHA_MASK ? 1 : 0;
    samples::GpuScene scene(device(), std::move(data));
    const samples::Lighting lighting(device(), scene, {.rays = restir::RayBackend::Software});
    samples::RayTracer first(device(), scene, device().bestRays()),
        software(device(), scene, restir::RayBackend::Software, lighting.bvh());
    std::optional<samples::RayTracer> pipeline;
    if (device().hasRayQuery() && device().hasRayPipelines()) pipeline.emplace(device(), scene, restir::RayBackend::Pipeline);
    const std::vector<samples::RsLoggedRay> primary =
        samples::primaryRays(samples::makePose(view, extent), extent);
    const std::vector<samples::RayHit> seen = first.trace(primary);
    const float reach = 2 * glm::distance(view.eye, view.target);
    for (const auto& [kind, rays] :
         {std::pair("primary", primary),
          std::pair("scattered", samples::scatteredRays(primary, seen, reach, true, 1)),
          std::pair("shadow", samples::scatteredRays(primary, seen, reach, false, 2))}) {
        const std::vector<samples::RayHit> hits = first.trace(rays);
        const samples::HitComparison c = samples::compareHits(rays, hits, software.trace(rays));
        std::printf(
            "%-14s %-10s %6zu rays, %6zu hits: %zu hit where the other misses, %zu hit another triangle "
            "elsewhere, %zu at the "
            "same place; t within %.1e; %zu masked materials\n",
            name, kind, c.rays, c.found, c.otherFound, c.otherTriangle, c.otherAtSame, c.largestT, masked);
        EXPECT_LE(double(c.otherFound + c.otherTriangle), 1 + 1e-4 * double(c.rays));
        EXPECT_LE(double(c.otherAtSame), 5 + 2e-3 * double(c.rays));
        EXPECT_LE(c.largestT, 1e-4);   // at grazing angles
        if (!pipeline) continue;
        const samples::HitComparison p = samples::compareHits(rays, hits, pipeline->trace(rays));
        std::printf("%14s %-10s by a pipeline: %zu, %zu, %zu, within %.1e\n", "", kind, p.otherFound,
                    p.otherTriangle, p.otherAtSame, p.largestT);
        EXPECT_EQ(p.otherFound + p.otherTriangle, 0u);   // the same structure
        EXPECT_LE(p.largestT, 1e-6);
    }
}

TEST(SoftwareAgreement, Cornell) { expectAgreement("cornell", samples::makeBuiltin("cornell"), {200, 120}); }
TEST(SoftwareAgreement, Market) { expectAgreement("market", samples::makeBuiltin("market"), {200, 120}); }
TEST(SoftwareAgreement, SharedScenesWithAlphaTests) {
    for (const char* name : {"stained_glass_lamp/StainedGlassLamp.gltf", "hotel_room/hotel_room.glb"}) {
        if (sharedScene(name).empty()) continue;
        std::vector<std::string> warnings;
        expectAgreement(name, samples::loadScene(sharedScene(name), warnings), {200, 120});
    }
}

}   // namespace
}   // namespace tests
