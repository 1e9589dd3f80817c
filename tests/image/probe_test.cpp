// samples/probe: what a shader of the host's own makes of the light tables, against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <common/lighting.h>
#include <probe/probes.h>
#include <proof/student.h>

#include "image/stage.h"
#include "image/world.h"

namespace tests {
namespace {

using restir::LightKind;

constexpr uint32_t kSeeds = 48, kDraws = 64, kProbes = 12;
constexpr glm::vec3 kBall{0.5f, 1, 0.2f}, kBulb{-0.7f, 1.1f, 0.4f}, kSky{0.2f, 0.1f, 0.3f};

// A lamp that is in the acceleration structure, a sphere that is not, a bulb, and a sky of one colour.
samples::SceneData hall() {
    samples::SceneData scene = planeScene();
    addQuad(scene, lamp({0, 1.2f, 0}, 0.3f), {.color = {0, 0, 0}, .emission = {3, 2, 1}});
    scene.shapes = {{.kind = LightKind::Sphere,
                     .position = {kBall.x, kBall.y, kBall.z},
                     .radius = 0.2f,
                     .emission = {1, 4, 2}}};
    scene.punctual = {{.position = kBulb, .intensity = {0.5f, 0.5f, 2}}};
    scene.sky.map = {4, 2, {}};
    for (int i = 0; i < 8; ++i) scene.sky.map.rgb.insert(scene.sky.map.rgb.end(), {kSky.x, kSky.y, kSky.z});
    return scene;
}

// The lamp hides some of the sky, as a diffuse source of -1 would.
glm::dvec3 truth(glm::dvec3 p) {
    const glm::dvec3 toBall = glm::dvec3(kBall) - p, toBulb = glm::dvec3(kBulb) - p;
    const double lit = lampIrradiance(lamp({0, 1.2f, 0}, 0.3f), p), d = glm::length(toBulb);
    return lit * (glm::dvec3(3, 2, 1) - glm::dvec3(kSky)) + std::numbers::pi * glm::dvec3(kSky) +
           sphereIrradiance(toBall, 0.2) * glm::dvec3(1, 4, 2) +
           toBulb.y / (d * d * d) * glm::dvec3(0.5, 0.5, 2);
}

// Each probe's mean over seeds, and the standard error of that.
struct Estimates {
    glm::dvec3 mean[kProbes] = {}, error[kProbes] = {};
};

Estimates estimate(const probe::Probes& probes, float treeShare) {
    Estimates e;
    glm::dvec3 squares[kProbes] = {};
    for (uint32_t seed = 0; seed < kSeeds; ++seed) {
        probes.light(kDraws, seed, treeShare);
        for (uint32_t i = 0; i < kProbes; ++i) {
            const glm::dvec3 value(probes.probes()[i].irradiance);
            e.mean[i] += value / double(kSeeds);
            squares[i] += value * value / double(kSeeds);
        }
    }
    for (uint32_t i = 0; i < kProbes; ++i)
        e.error[i] = glm::sqrt(glm::max(squares[i] - e.mean[i] * e.mean[i], glm::dvec3(0)) / double(kSeeds - 1));
    return e;
}

void place(const probe::Probes& probes) {
    for (uint32_t i = 0; i < kProbes; ++i)
        probes.probes()[i] = {
            {0.3f * float(i % 4) - 0.5f, 0.1f + 0.2f * float(i / 4), 0.15f * float(i % 3)}, {0, 1, 0}, {}};
}

TEST(Probe, IrradianceIsItsClosedForm) {
    const double bound = studentBound(3.0 * kProbes * 4, kSeeds - 1);
    for (samples::Emitters emitters : {samples::Emitters::Uploaded, samples::Emitters::Meshes}) {
        samples::GpuScene scene(device(), hall());
        const samples::Lighting lighting(device(), scene, {.emitters = emitters});
        const probe::Probes probes(device(), scene, lighting.lights(), kProbes);
        place(probes);
        for (float treeShare : {0.0f, 0.75f}) {
            const Estimates found = estimate(probes, treeShare);
            for (uint32_t i = 0; i < kProbes; ++i) {
                const glm::dvec3 wanted = truth(glm::dvec3(probes.probes()[i].position));
                for (int c = 0; c < 3; ++c) {
                    EXPECT_NEAR(found.mean[i][c], wanted[c], bound * found.error[i][c])
                        << "probe " << i << ", channel " << c << ", tree " << treeShare;
                    EXPECT_LT(found.error[i][c], (treeShare > 0 ? 0.07 : 0.04) * wanted[c]);   // most is the sky's
                }
            }
        }
    }
}

// Of 2,000 lamps over a field of 40 m few light a probe. In mid-air, without a plane, they are found as well.
TEST(Probe, TreeFindsTheLampsNearBy) {
    samples::SceneData data = planeScene();
    samples::build::Rng rng(3);
    for (uint32_t i = 0; i < 2000; ++i)
        data.punctual.push_back(
            {.position = {rng.range(-20, 20), rng.range(1, 2), rng.range(-20, 20)}, .intensity = glm::vec3(0.1f)});
    samples::GpuScene scene(device(), data);
    const samples::Lighting lighting(device(), scene);
    const probe::Probes probes(device(), scene, lighting.lights(), kProbes);
    place(probes);
    const double bound = studentBound(kProbes * 4, kSeeds - 1);
    for (bool plane : {true, false}) {
        double wanted[kProbes] = {};
        for (uint32_t i = 0; i < kProbes; ++i) {
            probe::Probe& probe = probes.probes()[i];
            if (!plane) probe.normal = {0, 0, 0};
            for (const samples::PunctualLight& lamp : data.punctual) {
                const glm::dvec3 to(lamp.position - probe.position);
                const double distance = glm::length(to);
                wanted[i] += double(lamp.intensity.x) / (distance * distance) * (plane ? to.y / distance : 1);
            }
        }
        const Estimates power = estimate(probes, 0), tree = estimate(probes, 0.75f);
        double ratio = 0;
        for (uint32_t i = 0; i < kProbes; ++i) {
            EXPECT_NEAR(power.mean[i].x, wanted[i], bound * power.error[i].x);
            EXPECT_NEAR(tree.mean[i].x, wanted[i], bound * tree.error[i].x);
            ratio += std::pow(tree.error[i].x / power.error[i].x, 2.0) / kProbes;
        }
        std::printf("variance with the tree %.3f of that without\n", ratio);
        EXPECT_LT(ratio, 0.3);
    }
}

}   // namespace
}   // namespace tests
