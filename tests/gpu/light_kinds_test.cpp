// The kinds of light that have an extent and are no triangle: sampler against density, density against
// domain, and what arrives against an integral in double precision.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "light_run.h"
#include "support/closed_form.h"
#include "support/statistics.h"

namespace {

using glm::dvec2;
using glm::dvec3;
using restir::Light;
using restir::LightKind;
using tests::LightResult;

constexpr double kPi = std::numbers::pi;
constexpr double kBound = 4.8;   // of some sixty z

dvec3 toGlm(const float (&v)[3]) { return {double(v[0]), double(v[1]), double(v[2])}; }

// A point on a light: where, and its normal times the whole area.
struct Point {
    dvec3 at, normal;
};

// Concentric squares to concentric circles.
dvec2 disc(dvec2 uv) {
    const dvec2 p = 2.0 * uv - 1.0;
    if (p == dvec2(0)) return p;
    const bool wide = std::abs(p.x) > std::abs(p.y);
    const double r = wide ? p.x : p.y, angle = kPi / 4 * (wide ? p.y / p.x : p.x / p.y);
    return wide ? r * dvec2(std::cos(angle), std::sin(angle)) : r * dvec2(std::sin(angle), std::cos(angle));
}

Point pointOf(const Light& light, dvec2 uv) {
    const dvec3 p = toGlm(light.position);
    const double r = double(light.radius);
    if (light.kind == LightKind::Rectangle) {
        const dvec3 u = toGlm(light.vertex1) - p, v = toGlm(light.vertex2) - p;
        return {p + uv.x * u + uv.y * v, glm::cross(u, v)};
    }
    if (light.kind ==
        LightKind::Disk) {   // its edges are the packer's business: only symmetric questions are asked
        const dvec3 n = glm::normalize(toGlm(light.direction));
        const dvec3 x = glm::normalize(glm::cross(dvec3(0.3, 0.9, 0.1), n)), y = glm::cross(n, x);
        const dvec2 at = r * disc(uv);
        return {p + at.x * x + at.y * y, kPi * r * r * n};
    }
    // Spheres, and capsules along z.
    const double length = light.kind == LightKind::Capsule ? double(light.vertex1[2]) - p.z : 0;
    const double along = uv.x * (length + 2 * r), onAxis = std::clamp(along - r, 0.0, length);
    dvec3 n(std::cos(2 * kPi * uv.y), std::sin(2 * kPi * uv.y), 0);
    if (along < r || along > r + length) {
        const dvec2 q = disc({(along < r ? along : along - r - length) / r, uv.y});
        const double square = glm::dot(q, q);
        n = {q * std::sqrt(2 - square), (1 - square) * (along < r ? -1 : 1)};
    }
    return {p + dvec3(0, 0, onAxis) + r * n, 2 * kPi * r * (length + 2 * r) * n};
}

double solidAngle(const Light& light, dvec2 uv, dvec3 receiver, dvec3& direction) {
    const Point point = pointOf(light, uv);
    const double distance = glm::length(point.at - receiver);
    direction = (point.at - receiver) / distance;
    const double cosine = -glm::dot(point.normal, direction);
    return (light.twoSided ? std::abs(cosine) : std::max(cosine, 0.0)) / (distance * distance);
}

// Mean over a grid of n x n points of the square from `low`, `size` wide.
double mean(uint32_t n, dvec2 low, double size, const std::function<double(dvec2)>& f) {
    double sum = 0;
    for (uint32_t i = 0; i < n * n; ++i) sum += f(low + size * (dvec2(i % n, i / n) + 0.5) / double(n));
    return sum / (n * n);
}

const Light kSphere{
    .kind = LightKind::Sphere, .position = {0.3f, -0.2f, 2}, .radius = 0.8f, .emission = {2, 3, 5}};
const Light kTube{.kind = LightKind::Capsule,
                  .position = {0.4f, 0.1f, 0.6f},
                  .vertex1 = {0.4f, 0.1f, 2},
                  .radius = 0.3f,
                  .emission = {2, 3, 5}};
// Faces down.
const Light kRectangle{.kind = LightKind::Rectangle,
                       .position = {-1, -0.5f, 0.6f},
                       .vertex1 = {-1, 0.7f, 0.6f},
                       .vertex2 = {1.5f, -0.5f, 0.6f},
                       .emission = {2, 3, 5}};
const Light kSkewed{.kind = LightKind::Rectangle,
                    .twoSided = true,
                    .position = {-1, -0.5f, 0.6f},
                    .vertex1 = {1.5f, -0.2f, 0.7f},
                    .vertex2 = {-0.5f, 0.7f, 0.6f},
                    .emission = {2, 3, 5}};
const Light kDisk{.kind = LightKind::Disk,
                  .position = {0.3f, -0.2f, 1},
                  .direction = {0.1f, 0.2f, -3},
                  .radius = 0.8f,
                  .emission = {2, 3, 5}};

struct Case {
    const char* name;
    Light light;
    std::vector<glm::vec3> receivers;
    double domain = 1;   // the part of the domain that is drawn from; 0: that which faces the receiver
};
std::vector<Case> cases() {
    return {{"sphere", kSphere, {{0, 0, 0}, {0.3f, -0.2f, 1.15f}, {4, 30, -3}, {0.3f, 0.7f, 2}}, 0},
            {"sphere from inside", kSphere, {{0.3f, 0, 1.9f}}},
            {"capsule", kTube, {{0, 0, 0}, {2, 1, -0.5f}}},
            {"rectangle",
             kRectangle,
             {{0, 0, 0}, {0, 0, 0.55f}, {2, 0.6f, 0.1f}, {-1.2f, 0, 0.58f}, {-4, 9, -7}}},
            {"parallelogram", kSkewed, {{0, 0, 0}, {0.3f, 0.2f, 0.5f}}},
            {"disk", kDisk, {{0, 0, 0}, {0.5f, 0.1f, 0.7f}}}};
}

class LightKinds : public tests::GpuTest {};

TEST_F(LightKinds, SamplersFollowTheirDensities) {
    constexpr size_t kBins = 16;
    for (const Case& c : cases()) {
        for (glm::vec3 receiver : c.receivers) {
            SCOPED_TRACE(std::string(c.name) + " from " + std::to_string(receiver.x));
            const std::vector<LightResult> drawn =
                tests::runLight({.light = c.light, .receivers = {receiver}});
            const std::vector<LightResult> all =
                tests::runLight({.light = c.light, .receivers = {receiver}, .uniformly = true, .seed = 6});
            // The density integrates to 1, over what it can draw.
            std::vector<double> density, inverse;
            for (const LightResult& r : all) density.push_back(double(r.pdf));
            for (const LightResult& r : drawn) inverse.push_back(r.pdf > 0 ? 1 / double(r.pdf) : 0);
            const auto check = [](const tests::Mean& m, double expected) {
                if (m.error == 0)
                    EXPECT_NEAR(m.mean, expected, 1e-6);
                else
                    EXPECT_LT(std::abs(m.z(expected)), kBound) << m.mean << " vs " << expected;
            };
            check(tests::meanOf(density), 1);
            const double distance = glm::length(dvec3(receiver) - toGlm(c.light.position));
            check(tests::meanOf(inverse),
                  c.domain > 0 ? c.domain : (1 - double(c.light.radius) / distance) / 2);

            // What is drawn, against solid angles in double precision where density follows them.
            const bool bySolidAngle = drawn[0].pdf != 1 || drawn[1].pdf != 1;
            std::vector<uint64_t> counts(kBins * kBins);
            std::vector<double> expected(kBins * kBins, 1.0 / (kBins * kBins));
            for (const LightResult& r : drawn)
                ++counts[size_t(r.square().x * kBins) * kBins + size_t(r.square().y * kBins)];
            double sum = 0;
            for (size_t i = 0; bySolidAngle && i < expected.size(); ++i)
                sum += expected[i] =
                    mean(48, dvec2(i / kBins, i % kBins) / double(kBins), 1.0 / kBins, [&](dvec2 uv) {
                        dvec3 direction;
                        return solidAngle(c.light, uv, receiver, direction);
                    });
            for (double& p : expected) p /= bySolidAngle ? sum : 1;
            EXPECT_LT(std::abs(tests::chiSquareZ(counts, expected, drawn.size())), kBound);
        }
    }
}

TEST_F(LightKinds, WhatArrivesIsTheIntegral) {
    const dvec3 n = glm::normalize(dvec3(0.1, -0.05, 1));
    for (const Case& c : cases()) {
        for (glm::vec3 receiver : c.receivers) {
            SCOPED_TRACE(std::string(c.name) + " from " + std::to_string(receiver.x));
            std::vector<double> green, angle;
            for (const LightResult& r : tests::runLight({.light = c.light, .receivers = {receiver}})) {
                const double weight = r.pdf > 0 ? 1 / double(r.pdf) : 0;
                green.push_back(double(r.irradiance.y) * std::max(glm::dot(dvec3(r.direction), n), 0.0) *
                                weight);
                angle.push_back(double(r.solidAngle) * weight);
            }
            dvec3 direction;
            const double whole =
                mean(1200, {0, 0}, 1, [&](dvec2 uv) { return solidAngle(c.light, uv, receiver, direction); });
            const double irradiance = mean(1200, {0, 0}, 1, [&](dvec2 uv) {
                const double omega = solidAngle(c.light, uv, receiver, direction);
                return 3 * omega * std::max(glm::dot(direction, n), 0.0);
            });
            for (const auto& [values, expected] : {std::pair(&green, irradiance), std::pair(&angle, whole)}) {
                const tests::Mean m = tests::meanOf(*values);
                // The grid's own error.
                EXPECT_NEAR(m.mean, expected, kBound * m.error + 1e-4 * expected);
                EXPECT_LE(m.error, 0.01 * expected);
            }
        }
    }
}

TEST_F(LightKinds, ClosedForms) {
    const auto irradiance = [](const Light& light, glm::vec3 receiver) {
        std::vector<double> red;
        for (const LightResult& r : tests::runLight({.light = light, .receivers = {receiver}}))
            red.push_back(r.pdf > 0
                              ? double(r.irradiance.x) * std::max(double(r.direction.z), 0.0) / double(r.pdf)
                              : 0);
        return tests::meanOf(red);
    };
    Light sphere = kSphere;
    sphere.position[0] = sphere.position[1] = 0;
    for (float radius : {1.5f, 0.3f, 1e-3f}) {
        sphere.radius = radius;
        const double sine = double(radius) / 2;
        EXPECT_NEAR(irradiance(sphere, {0, 0, 0}).mean, 2 * kPi * sine * sine, 4e-3 * kPi * sine * sine)
            << radius;
    }
    const Light disk{.kind = LightKind::Disk,
                     .position = {0, 0, 0.7f},
                     .direction = {0, 0, -1},
                     .radius = 1.2f,
                     .emission = {2, 2, 2}};
    const tests::Mean onAxis = irradiance(disk, {0, 0, 0});
    EXPECT_LT(std::abs(onAxis.z(2 * kPi * 1.44 / (1.44 + 0.49))), kBound);
    // A rectangle is its two triangles.
    const dvec3 a = toGlm(kRectangle.position), b = toGlm(kRectangle.vertex1), d = toGlm(kRectangle.vertex2),
                c = b + d - a;
    for (glm::vec3 receiver : {glm::vec3(0, 0, 0), glm::vec3(0.2f, 0.1f, 0.59f), glm::vec3(3, 2, 0.3f)}) {
        const std::array<dvec3, 3> one{a, b, d}, two{d, b, c};
        const double expected = 2 * (tests::triangleIrradiance(receiver, {0, 0, 1}, one) +
                                     tests::triangleIrradiance(receiver, {0, 0, 1}, two));
        const tests::Mean m = irradiance(kRectangle, receiver);
        EXPECT_NEAR(m.mean, expected, kBound * m.error + 2e-5 * expected);
    }
}

TEST_F(LightKinds, DegenerateOnesAreDark) {
    Light sphere = kSphere, disk = kDisk, tube = kTube, flat = kRectangle;
    sphere.radius = disk.radius = tube.radius = 0;
    for (int i = 0; i < 3; ++i) flat.vertex2[i] = flat.position[i];
    const std::vector<glm::vec3> around{{0, 0, 0}, {0.3f, -0.2f, 2}, {0.4f, 0.1f, 1}, {-1, 0, 0.6f}};
    for (const Light& light : {sphere, disk, tube, flat})
        for (const LightResult& r : tests::runLight({.light = light, .receivers = around, .samples = 1024}))
            EXPECT_EQ(r.irradiance, glm::vec3(0));
    // On, in and level with those that shine.
    for (const Light& light : {kSphere, kDisk, kTube, kRectangle})
        for (const LightResult& r : tests::runLight({.light = light, .receivers = around, .samples = 1024})) {
            EXPECT_TRUE(std::isfinite(r.irradiance.x) && r.irradiance.x >= 0);
            EXPECT_TRUE(std::isfinite(r.pdf) && r.pdf >= 0);
        }
    for (const LightResult& r :
         tests::runLight({.light = kSphere, .receivers = {{0.3f, 0.2f, 2.1f}}, .samples = 1024}))
        EXPECT_EQ(r.irradiance, glm::vec3(0)) << "from inside";
}

TEST_F(LightKinds, SunsKeepTheirIrradiance) {
    for (float radius : {0.00465f, 0.2f, 1.2f, 1.5707963f}) {
        const Light sun{.kind = LightKind::Directional,
                        .direction = {0.1f, 0.4f, -1},
                        .angularRadius = radius,
                        .emission = {2, 3, 5}};
        const dvec3 toSun = -glm::normalize(toGlm(sun.direction));
        std::vector<double> blue;
        std::vector<uint64_t> rings(8);
        for (const LightResult& r : tests::runLight({.light = sun})) {
            const double cosine = glm::dot(dvec3(r.direction), toSun),
                         less = glm::length(dvec3(r.direction) - toSun);
            blue.push_back(double(r.irradiance.z) * cosine);
            const double share = 0.5 * less * less / (1 - std::cos(double(radius)));
            ASSERT_LT(share, 1.001);
            ++rings[std::min(size_t(share * 8), size_t{7})];
            EXPECT_EQ(r.pdf, 1);
            ASSERT_NEAR(double(r.solidAngle), 2 * kPi * (1 - std::cos(double(radius))),
                        1e-4 * double(r.solidAngle));
            // Rays find the point again.
            const int du = int(r.found & 0xffffu) - int(r.uv & 0xffffu),
                      dv = int(r.found >> 16) - int(r.uv >> 16);
            if (radius > 0.1f && r.found != 0xffffffffu) {
                ASSERT_LE(std::max(std::abs(du), std::abs(dv)), 2) << radius;
            }
        }
        const tests::Mean m = tests::meanOf(blue);
        EXPECT_NEAR(m.mean, 5, kBound * m.error + 1e-5);
        const std::vector<double> uniform(8, 1.0 / 8);
        if (radius > 0.1f) {
            EXPECT_LT(std::abs(tests::chiSquareZ(rings, uniform, blue.size())), kBound) << radius;
        }
    }
}

// One texel in 512 is 50,000 times as bright; one row is black.
std::vector<float> sunny(uint32_t width, uint32_t height) {
    std::vector<float> rgb(size_t{3} * width * height, 1.0f);
    for (uint32_t y = 0; y < height; ++y)
        for (uint32_t x = 0; x < width; ++x)
            for (uint32_t c = 0; c < 3; ++c) {
                float& value = rgb[3 * (size_t{y} * width + x) + c];
                value = 0.2f + float(x + c) / float(width);
                if (y + 3 >= height) value = 0;
                if (y == 4 && x == 9) value = 50000;
            }
    return rgb;
}

Light environment() {
    const float half = 0.4f;
    return {.kind = LightKind::Environment, .rotation = {0, std::sin(half), 0, std::cos(half)}, .texture = 0};
}

TEST_F(LightKinds, EnvironmentsAreDrawnAsTheirTableSays) {
    for (const auto& [width, height] : {std::pair(32u, 16u), std::pair(27u, 11u), std::pair(1u, 1u)}) {
        SCOPED_TRACE(width);
        std::vector<float> rgb = sunny(width, height);
        if (width == 1) rgb = {1, 1, 1};
        const restir::EnvironmentMap map{width, height, rgb};
        const restir::EnvironmentImportance importance = restir::weighEnvironment(map);
        std::vector<double> probability, density, inverse;
        double shining = 0;
        for (const auto& texel : importance.texels) {
            probability.push_back(double(texel.probability));
            shining += texel.probability > 0 ? 1.0 / (width * height) : 0;
        }
        const std::vector<LightResult> drawn = tests::runLight({.light = environment(), .environment = map});
        std::vector<uint64_t> counts(importance.texels.size());
        for (const LightResult& r : drawn) {
            ++counts[size_t(r.square().y * height) * width + size_t(r.square().x * width)];
            ASSERT_EQ(r.distance, 1e30f);
            inverse.push_back(1 / double(r.pdf));
            // A direction finds its own point, but for rounding.
            ASSERT_NE(r.found, 0xffffffffu);
            const int du = std::abs(int(r.found & 0xffffu) - int(r.uv & 0xffffu)),
                      dv = int(r.found >> 16) - int(r.uv >> 16);
            if (std::abs(r.square().y - 0.5) < 0.45) {
                ASSERT_TRUE(std::min(du, 65536 - du) <= 1 && std::abs(dv) <= 1);
            }
        }
        EXPECT_LT(std::abs(tests::chiSquareZ(counts, probability, drawn.size())), kBound);
        const tests::Mean measure = tests::meanOf(inverse);
        EXPECT_NEAR(measure.mean, shining, kBound * measure.error + 1e-6);
        std::vector<double> sphere;
        for (const LightResult& r :
             tests::runLight({.light = environment(), .uniformly = true, .environment = map})) {
            density.push_back(double(r.pdf));
            sphere.push_back(double(r.solidAngle));
        }
        const tests::Mean one = tests::meanOf(density), whole = tests::meanOf(sphere);
        EXPECT_NEAR(one.mean, 1, kBound * one.error + 1e-6);
        EXPECT_LT(std::abs(whole.z(4 * kPi)), kBound);
    }
}

// The stub texture answers (u, v, 1/2): what is drawn from another map integrates it all the same.
TEST_F(LightKinds, EnvironmentsIntegrateTheirTexture) {
    const std::vector<float> rgb{0.3f, 0.3f, 0.3f, 1, 1, 1, 2, 0, 0, 0.1f, 0.1f, 0.1f};
    std::vector<double> red, blue;
    for (const LightResult& r : tests::runLight({.light = environment(), .environment = {2, 2, rgb}})) {
        const double up = std::max(double(r.direction.y), 0.0);
        red.push_back(double(r.irradiance.x) / double(r.pdf) * up);
        blue.push_back(double(r.irradiance.z) / double(r.pdf) * up);
        // 0.8 rad about y take the map's x axis, u = 1/2, to (cos, 0, -sin).
        const double phi = 2 * kPi * (r.square().x - 0.5) - 0.8, sine = std::sin(kPi * r.square().y);
        const dvec3 expected(sine * std::cos(phi), std::cos(kPi * r.square().y), sine * std::sin(phi));
        ASSERT_LT(glm::length(dvec3(r.direction) - expected), 1e-5);
    }
    EXPECT_LT(std::abs(tests::meanOf(blue).z(0.5 * kPi)), kBound);
    EXPECT_LT(std::abs(tests::meanOf(red).z(0.5 * kPi)), kBound);   // the mean of u is 1/2
}

}   // namespace
