// Light sampling against closed forms.
#include <array>
#include <cmath>
#include <numbers>

#include <glm/gtc/quaternion.hpp>

#include "light_run.h"
#include "support/closed_form.h"
#include "support/gpu.h"
#include "support/statistics.h"

namespace {

using restir::Light;
using restir::LightKind;

constexpr uint32_t kSamples = 1u << 18;

using Result = tests::LightResult;

std::vector<Result> run(const Light& light, const std::vector<glm::vec3>& receivers, uint32_t samples) {
    return tests::runLight({.light = light, .receivers = receivers, .samples = samples});
}
std::vector<Result> evaluate(const Light& light, std::vector<glm::vec3> receivers) {
    std::vector<Result> results = run(light, receivers, 64);
    results.resize(receivers.size());
    return results;
}

// Faces down onto the plane z = 0.
const Light kTriangle{.position = {-0.5f, -0.3f, 1.2f},
                      .vertex1 = {0.1f, 0.9f, 1.0f},
                      .vertex2 = {0.8f, -0.4f, 1.5f},
                      .emission = {2, 3, 5}};
constexpr std::array<glm::dvec3, 3> kCorners{glm::dvec3(-0.5f, -0.3f, 1.2f), glm::dvec3(0.1f, 0.9f, 1.0f),
                                             glm::dvec3(0.8f, -0.4f, 1.5f)};

class Lights : public tests::GpuTest {};

// Barycentrics are uniform over the simplex: its 1/8 grid has 28 whole cells of 1/32 and 8 halves of 1/64.
TEST_F(Lights, PointsAreUniformOnTheTriangle) {
    std::vector<uint64_t> counts(64);
    std::vector<double> probabilities(64);
    for (size_t u = 0; u < 8; ++u)
        for (size_t v = 0; u + v < 8; ++v) probabilities[u * 8 + v] = u + v < 7 ? 1 / 32.0 : 1 / 64.0;
    for (const Result& r : run(kTriangle, {{0, 0, 0}}, kSamples)) {
        ASSERT_LE((r.uv & 0xffffu) + (r.uv >> 16), 0xffffu);
        ++counts[static_cast<size_t>(std::min(r.barycentrics().x * 8, 7.0)) * 8 +
                 static_cast<size_t>(std::min(r.barycentrics().y * 8, 7.0))];
    }
    EXPECT_LT(std::abs(tests::chiSquareZ(counts, probabilities, kSamples)), 4.5);
}

TEST_F(Lights, ATriangleIntegratesToItsClosedForm) {
    for (glm::vec3 receiver : {glm::vec3(0, 0, 0), glm::vec3(2, 0.5f, 0), glm::vec3(0.1f, 0.1f, 0.7f)}) {
        const glm::dvec3 n = glm::normalize(glm::dvec3(0.1, -0.05, 1));
        std::vector<double> red, blue, solidAngle;
        for (const Result& r : run(kTriangle, {receiver}, kSamples)) {
            const double cosine = glm::dot(glm::dvec3(r.direction), n);
            red.push_back(double(r.irradiance.x) * cosine);
            blue.push_back(double(r.irradiance.z) * cosine);
            solidAngle.push_back(double(r.solidAngle));
        }
        const double irradiance = tests::triangleIrradiance(receiver, n, kCorners);
        for (const auto& [samples, expected] :
             {std::pair(&red, 2 * irradiance), std::pair(&blue, 5 * irradiance),
              std::pair(&solidAngle, tests::triangleSolidAngle(receiver, kCorners))}) {
            const tests::Mean mean = tests::meanOf(*samples);
            EXPECT_LT(mean.relativeError(), 0.003);
            EXPECT_LT(std::abs(mean.z(expected)), 4.5) << mean.mean << " vs " << expected;
        }
    }
}

TEST_F(Lights, ATrianglesPointIsWhereItsBarycentricsSay) {
    const glm::dvec3 receiver(0.3, 0.2, 0);
    for (const Result& r : run(kTriangle, {receiver}, 256)) {
        const glm::dvec2 at = r.barycentrics();
        const glm::dvec3 point =
            kCorners[0] + at.x * (kCorners[1] - kCorners[0]) + at.y * (kCorners[2] - kCorners[0]);
        EXPECT_NEAR(r.distance, glm::length(point - receiver), 1e-5);
        EXPECT_LT(glm::distance(glm::dvec3(r.direction), glm::normalize(point - receiver)), 1e-5);
    }
}

TEST_F(Lights, BacksAreBlackUnlessTwoSided) {
    const glm::vec3 behind(0, 0, 4);
    Light twoSided = kTriangle;
    twoSided.twoSided = true;
    std::vector<double> back;
    for (const Result& r : run(kTriangle, {behind}, 256)) {
        EXPECT_EQ(r.irradiance, glm::vec3(0));
        EXPECT_EQ(r.solidAngle, 0);
    }
    for (const Result& r : run(twoSided, {behind}, kSamples))
        back.push_back(double(r.irradiance.x) * -double(r.direction.z));
    const double expected = 2 * std::abs(tests::triangleIrradiance(behind, {0, 0, -1}, kCorners));
    EXPECT_LT(std::abs(tests::meanOf(back).z(expected)), 4.5);
    for (const Result& r : run(twoSided, {{0, 0, 0}}, 64)) EXPECT_GT(r.irradiance.x, 0);
}

TEST_F(Lights, DegenerateTrianglesGiveNothing) {
    Light line = kTriangle;
    for (int i = 0; i < 3; ++i) line.vertex2[i] = line.vertex1[i];
    for (const Result& r : run(line, {{0, 0, 0}}, 64)) EXPECT_EQ(r.irradiance, glm::vec3(0));
    // From the triangle itself.
    for (const Result& r : run(kTriangle, {{-0.5f, -0.3f, 1.2f}}, 256))
        EXPECT_TRUE(std::isfinite(r.irradiance.x) && r.irradiance.x >= 0);
}

TEST_F(Lights, TexturesTintTheSampledPoint) {
    Light light = kTriangle;
    light.texture = 3;
    light.uv[1][0] = 1;   // the stub texture answers (u, v, 1/2)
    light.uv[2][1] = 1;
    const std::vector<Result> plain = run(kTriangle, {{0, 0, 0}}, 256),
                              textured = run(light, {{0, 0, 0}}, 256);
    for (size_t i = 0; i < plain.size(); ++i) {
        const glm::vec3 tint(plain[i].barycentrics(), 0.5f);
        EXPECT_LT(glm::distance(textured[i].irradiance, plain[i].irradiance * tint),
                  1e-5f * glm::length(plain[i].irradiance));
    }
}

const std::vector<glm::vec3> kReceivers{
    {0, 0, 0}, {1, 0, 0},    {0, 0.5f, 1},  {-2, 1, 0.5f}, {0.1f, 0, 1.9f}, {0, 0, 3},     {5, 5, 0},
    {1, 1, 1}, {0.4f, 0, 0}, {0, -1.2f, 0}, {3, 0, -2},    {0, 0, -7.9f},   {0, 0, -8.1f}, {0, 0, -30}};

void expectPunctual(const Light& light) {
    const std::vector<Result> results = evaluate(light, kReceivers);
    for (size_t i = 0; i < kReceivers.size(); ++i) {
        const glm::dvec3 expected = tests::lightIrradiance(light, kReceivers[i], results[i].direction);
        for (int k = 0; k < 3; ++k)
            EXPECT_NEAR(results[i].irradiance[k], expected[k], 2e-5 * expected[k] + 1e-6) << "receiver " << i;
        EXPECT_EQ(results[i].solidAngle, 0);
        EXPECT_EQ(results[i].uv, 0u);
        if (light.kind == LightKind::Directional) continue;
        const glm::vec3 toLight =
            glm::vec3(light.position[0], light.position[1], light.position[2]) - kReceivers[i];
        EXPECT_NEAR(results[i].distance, glm::length(toLight), 1e-5);
        EXPECT_LT(glm::distance(results[i].direction, glm::normalize(toLight)), 1e-5);
    }
}

TEST_F(Lights, PointLights) {
    expectPunctual({.kind = LightKind::Point, .position = {0, 0, 2}, .emission = {5, 6, 7}});
    expectPunctual({.kind = LightKind::Point, .position = {0, 0, 2}, .range = 10, .emission = {5, 6, 7}});
}

TEST_F(Lights, SpotLights) {
    Light spot{
        .kind = LightKind::Spot, .position = {0, 0, 2}, .direction = {0.5f, 0, -2}, .emission = {5, 6, 7}};
    spot.innerCone = 0.2f;
    spot.outerCone = 0.6f;
    expectPunctual(spot);
    spot.range = 10;
    spot.innerCone = 0;
    spot.outerCone = 1.5707963f;
    expectPunctual(spot);
}

// The stub texture answers (u, v, 1/2).
TEST_F(Lights, ProfilesShineByDirection) {
    Light light{.kind = LightKind::Point, .position = {0, 0, 2}, .emission = {5, 6, 7}, .texture = 3};
    const glm::dquat turn = glm::normalize(glm::dquat(0.3, -0.5, 0.7, 0.2));
    glm::dmat3 axes = glm::mat3_cast(turn);
    const auto check = [&](const char* kind) {
        Light plain = light;
        plain.texture = RS_NO_TEXTURE;
        const std::vector<Result> bare = evaluate(plain, kReceivers), shaped = evaluate(light, kReceivers);
        for (size_t i = 0; i < kReceivers.size(); ++i) {
            const glm::dvec3 d =
                glm::transpose(axes) * glm::normalize(glm::dvec3(kReceivers[i]) - glm::dvec3(0, 0, 2));
            if (std::hypot(d.x, d.y) < 1e-6) continue;   // u is anything on the axis
            const double u = std::atan2(d.y, d.x) / (2 * std::numbers::pi),
                         v = std::acos(-d.z) / std::numbers::pi;
            const glm::vec3 factor(u < 0 ? u + 1 : u, v, 0.5);
            EXPECT_LE(glm::distance(shaped[i].irradiance, bare[i].irradiance * factor),
                      1e-5f * glm::length(bare[i].irradiance))
                << kind << ", receiver " << i;
        }
    };
    const double rotation[] = {turn.x, turn.y, turn.z, turn.w};
    for (int k = 0; k < 4; ++k) light.rotation[k] = float(rotation[k]);
    check("point");
    // A spot's profile is about its direction, -z here, turned to where the rotation has its x.
    light.kind = LightKind::Spot;
    light.outerCone = 1.2f;
    const glm::dvec3 x = glm::normalize(glm::dvec3(axes[0].x, axes[0].y, 0)), z(0, 0, 1);
    axes = glm::dmat3(x, glm::cross(z, x), z);
    check("spot");
}

TEST_F(Lights, DirectionalLights) {
    expectPunctual({.kind = LightKind::Directional, .direction = {1, 2, -2}, .emission = {1, 2, 3}});
    const Result r = evaluate({.kind = LightKind::Directional, .direction = {0, 0, -5}}, {{1, 2, 3}})[0];
    EXPECT_EQ(r.direction, glm::vec3(0, 0, 1));
    EXPECT_GE(r.distance, 1e30f);
}

TEST_F(Lights, APointLightAtTheReceiverIsDark) {
    const Result r = evaluate({.kind = LightKind::Point, .position = {1, 1, 1}}, {{1, 1, 1}})[0];
    EXPECT_EQ(r.irradiance, glm::vec3(0));
}

}   // namespace
