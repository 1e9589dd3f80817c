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

TEST(Probe, IrradianceIsItsClosedForm) {
    for (samples::Emitters emitters : {samples::Emitters::Uploaded, samples::Emitters::Meshes}) {
        samples::GpuScene scene(device(), hall());
        const samples::Lighting lighting(device(), scene, {.emitters = emitters});
        const probe::Probes probes(device(), scene, lighting.lights(), kProbes);
        for (uint32_t i = 0; i < kProbes; ++i)
            probes.probes()[i] = {
                {0.3f * float(i % 4) - 0.5f, 0.1f + 0.2f * float(i / 4), 0.15f * float(i % 3)},
                {0, 1, 0},
                {}};
        glm::dvec3 sum[kProbes] = {}, squares[kProbes] = {};
        for (uint32_t seed = 0; seed < kSeeds; ++seed) {
            probes.light(kDraws, seed);
            for (uint32_t i = 0; i < kProbes; ++i) {
                const glm::dvec3 value(probes.probes()[i].irradiance);
                sum[i] += value;
                squares[i] += value * value;
            }
        }
        const double bound = studentBound(3.0 * kProbes * 2, kSeeds - 1);
        for (uint32_t i = 0; i < kProbes; ++i) {
            const glm::dvec3 mean = sum[i] / double(kSeeds),
                             wanted = truth(glm::dvec3(probes.probes()[i].position));
            for (int c = 0; c < 3; ++c) {
                const double error =
                    std::sqrt(std::max(squares[i][c] / kSeeds - mean[c] * mean[c], 0.0) / (kSeeds - 1));
                EXPECT_NEAR(mean[c], wanted[c], bound * error) << "probe " << i << ", channel " << c;
                EXPECT_LT(error, 0.04 * wanted[c]);
            }
        }
    }
}

}   // namespace
}   // namespace tests
