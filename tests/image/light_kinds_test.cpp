// Lights of every shape and the sky over a plane, each alone against a closed form; the odd ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "image/hypothesis.h"
#include "image/stage.h"
#include "image/world.h"

namespace tests {
namespace {

using restir::Light;
using restir::LightKind;
using samples::Sequence;

constexpr VkExtent2D kExtent{32, 32};
constexpr uint32_t kPictures = 40, kFrames = 6;
constexpr glm::vec3 kRadiance{3, 5, 7};

const Light kSphere{
    .kind = LightKind::Sphere, .position = {-0.4f, 0.5f, -0.2f}, .radius = 0.35f, .emission = {3, 5, 7}};
const Light kDisk{.kind = LightKind::Disk,
                  .position = {0.2f, 0.6f, 0.1f},
                  .direction = {0, -1, 0},
                  .radius = 0.5f,
                  .emission = {3, 5, 7}};
const Light kPanel{.kind = LightKind::Rectangle,
                   .position = {-0.5f, 0.4f, -0.5f},
                   .vertex1 = {0.5f, 0.4f, -0.5f},
                   .vertex2 = {-0.5f, 0.4f, 0.3f},
                   .emission = {3, 5, 7}};
const Light kTube{.kind = LightKind::Capsule,
                  .position = {-0.6f, 0.5f, -0.2f},
                  .vertex1 = {0.6f, 0.4f, 0.1f},
                  .radius = 0.08f,
                  .emission = {3, 5, 7}};
const Light kSun{.kind = LightKind::Directional,
                 .direction = {0.3f, -2, -0.5f},
                 .angularRadius = 0.1f,
                 .emission = {3, 5, 7}};

samples::FloatImage constantSky(glm::vec3 radiance, uint32_t width, uint32_t height) {
    samples::FloatImage map{width, height, {}};
    for (uint32_t i = 0; i < width * height; ++i)
        map.rgb.insert(map.rgb.end(), {radiance.x, radiance.y, radiance.z});
    return map;
}
// By the capsule's surface, facet by facet.
double tubeIrradiance(glm::dvec3 point) {
    constexpr int kAlong = 64, kAround = 32;
    const glm::dvec3 a(kTube.position[0], kTube.position[1], kTube.position[2]),
        b(kTube.vertex1[0], kTube.vertex1[1], kTube.vertex1[2]);
    const double r = double(kTube.radius), length = glm::length(b - a);
    const glm::dvec3 axis = (b - a) / length, x = glm::normalize(glm::cross(axis, glm::dvec3(0, 1, 0))),
                     y = glm::cross(axis, x);
    double sum = 0;
    for (int i = 0; i < kAlong * kAround; ++i) {
        // Steps of equal area, from tip to tip.
        const double along = (length + 2 * r) * ((i / kAround) + 0.5) / kAlong - r,
                     phi = 2 * std::numbers::pi * (i % kAround) / kAround;
        const double onAxis = std::clamp(along, 0.0, length), z = (along - onAxis) / r;
        const glm::dvec3 n = z * axis + std::sqrt(1 - z * z) * (std::cos(phi) * x + std::sin(phi) * y);
        const glm::dvec3 d = a + onAxis * axis + r * n - point;
        const double d2 = glm::dot(d, d);
        sum += std::max(-glm::dot(n, d), 0.0) * std::max(d.y, 0.0) / (d2 * d2);
    }
    return sum * 2 * std::numbers::pi * r * (length + 2 * r) / (kAlong * kAround);
}

glm::dvec3 away(const Light& light, glm::dvec3 p) {
    return glm::dvec3(light.position[0], light.position[1], light.position[2]) - p;
}

struct Alone {
    const char* name;
    Light light;   // an environment: a sky of one radiance
    std::function<double(glm::dvec3)> irradiance;
};
std::vector<Alone> alone() {
    const samples::build::Patch panel{.origin = {-0.5f, 0.4f, -0.5f}, .u = {1, 0, 0}, .v = {0, 0, 0.8f}};
    return {
        {"sphere", kSphere,
         [](glm::dvec3 p) { return sphereIrradiance(away(kSphere, p), double(kSphere.radius)); }},
        {"disk", kDisk, [](glm::dvec3 p) { return diskIrradiance(away(kDisk, p), double(kDisk.radius)); }},
        {"rectangle", kPanel, [=](glm::dvec3 p) { return lampIrradiance(panel, p); }},
        {"capsule", kTube, tubeIrradiance},
        {"sun", kSun, [](glm::dvec3) { return 2 / std::sqrt(0.3 * 0.3 + 4 + 0.5 * 0.5); }},
        {"sky", {.kind = LightKind::Environment}, [](glm::dvec3) { return std::numbers::pi; }}};
}

samples::SceneData planeWith(const Alone& one) {
    samples::SceneData scene = planeScene();
    if (one.light.kind == LightKind::Environment)
        scene.sky.map = constantSky(kRadiance, 7, 5);
    else
        scene.shapes = {one.light};
    return scene;
}

// Keeps blocks apart, and the frames of a sequence: more independent samples in a picture.
restir::Settings near() {
    restir::Settings settings = unbiased();
    settings.di.radius = 6;
    settings.di.maxHistory = 4;
    return settings;
}

restir::Settings nextEvent() {
    restir::Settings settings;
    settings.di.mode = restir::DirectMode::NextEvent;
    return settings;
}

TEST(LightKinds, EachAloneIsItsClosedForm) {
    std::vector<Alone> all = alone();
    Verdict verdict(3 * all.size(), kPictures);
    for (const Alone& one : all) {
        World world(planeWith(one), kExtent);
        const ReferenceBlocks truth = exactly(planePicture(world.view(), kExtent, 6, [&](glm::dvec3 p) {
            return glm::dvec3(kRadiance) * one.irradiance(p);
        }));
        const Sequence sequence{.view = world.view(), .frames = kFrames, .accumulate = true};
        verdict.add(std::string(one.name) + " restir",
                    compare(world.seeds(kPictures, sequence, near()), truth));
        verdict.add(std::string(one.name) + " next event",
                    compare(world.seeds(kPictures, sequence, nextEvent()), truth));
        verdict.add(std::string(one.name) + " reference",
                    compare(world.referenceSeeds(kPictures, sequence, {.paths = 12}), truth));
    }
    verdict.expectUnitVariance();
}

// What is behind the horizon, black or of no size lights nothing, and harms nothing.
TEST(LightKinds, OddOnes) {
    samples::SceneData scene = planeScene();
    Light below = kSun, nothing = kSphere, flat = kPanel, level = kDisk;
    below.direction[1] = 1;
    nothing.radius = 0;
    for (int i = 0; i < 3; ++i) flat.vertex2[i] = flat.position[i];
    level.position[1] = 0;   // in the plane, facing it
    scene.shapes = {below, nothing, flat, level};
    scene.sky.map = constantSky({0, 0, 0}, 1, 1);
    World dark(scene, kExtent);
    const Sequence sequence{.view = dark.view(), .frames = 2};
    EXPECT_LT(largest(dark.render(sequence, unbiased())), 1e-3f);
    EXPECT_EQ(dark.renderer().stats().counters.rejectedWeights, 0u);

    scene.sky.map = constantSky({2, 2, 2}, 1, 1);
    scene.shapes.pop_back();
    World lit(scene, kExtent);
    SeedStatistics statistics =
        lit.seeds(kPictures, {.view = lit.view(), .frames = kFrames, .accumulate = true}, unbiased());
    Verdict verdict(1, kPictures);
    verdict.add("a map of one texel",
                compare(statistics, exactly(planePicture(lit.view(), kExtent, 1, [](glm::dvec3) {
                            return glm::dvec3(2 * std::numbers::pi);
                        }))));
}

}   // namespace
}   // namespace tests
