#include <lights/pack.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <string>

#include <gtest/gtest.h>

namespace {

using restir::Light;
using restir::LightKind;
using restir::PackedLights;
using restir::Status;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr uint32_t kMaxLights = 64, kMaxTextures = 100;

class LightPack : public ::testing::Test {
protected:
    Status pack(const std::vector<Light>& lights) {
        said_.clear();
        const restir::MessageSink sink{this, [](void* user, restir::Severity severity, const char* text) {
                                           EXPECT_EQ(severity, restir::Severity::Error);
                                           static_cast<LightPack*>(user)->said_ += text;
                                       }};
        return restir::packLights(sink, {.lights = kMaxLights, .textures = kMaxTextures}, lights, packed_);
    }
    const restir::gpu::RsPackedLight& at(uint32_t id) const { return packed_.lights[id]; }
    double selectionSum() const {
        double sum = 0;
        for (const auto& light : packed_.lights) sum += double(light.selection);
        return sum;
    }

    PackedLights packed_;
    std::string said_;
};

Light triangle(uint32_t id, float size = 1) {
    return {.id = id, .position = {1, 2, 3}, .vertex1 = {1 + size, 2, 3}, .vertex2 = {1, 2 + size, 3}};
}
Light of(LightKind kind, uint32_t id) { return {.id = id, .kind = kind}; }

struct BadLight {
    const char* field;   // what the message must name
    LightKind kind;
    std::function<void(Light&)> spoil;
};

std::vector<BadLight> badLights() {
    using K = LightKind;
    return {
        {"id", K::Point, [](Light& l) { l.id = kMaxLights; }},
        {"kind", K::Point, [](Light& l) { l.kind = static_cast<LightKind>(9); }},
        {"emission", K::Point, [](Light& l) { l.emission[1] = -0.1f; }},
        {"emission", K::Directional, [](Light& l) { l.emission[2] = kNan; }},
        {"emission", K::Triangle, [](Light& l) { l.emission[0] = kInfinity; }},
        {"position", K::Triangle, [](Light& l) { l.position[0] = kNan; }},
        {"position", K::Point, [](Light& l) { l.position[2] = kInfinity; }},
        {"position", K::Spot, [](Light& l) { l.position[1] = -kInfinity; }},
        {"vertex1", K::Triangle, [](Light& l) { l.vertex1[1] = kNan; }},
        {"vertex2", K::Triangle, [](Light& l) { l.vertex2[2] = kInfinity; }},
        {"meanLuminance", K::Triangle, [](Light& l) { l.meanLuminance = kNan; }},
        {"meanLuminance", K::Triangle, [](Light& l) { l.meanLuminance = kInfinity; }},
        {"meanLuminance", K::Triangle, [](Light& l) { l.meanLuminance = 0; }},
        {"texture", K::Triangle, [](Light& l) { l.texture = kMaxTextures; }},
        {"uv", K::Triangle, [](Light& l) { l.uv[2][1] = kNan; }},
        {"direction", K::Spot, [](Light& l) { l.direction[2] = 0; }},
        {"direction", K::Directional, [](Light& l) { l.direction[0] = kNan; }},
        {"range", K::Point, [](Light& l) { l.range = -1; }},
        {"range", K::Spot, [](Light& l) { l.range = kNan; }},
        {"innerCone", K::Spot, [](Light& l) { l.innerCone = -0.1f; }},
        {"innerCone", K::Spot, [](Light& l) { l.innerCone = l.outerCone; }},
        {"innerCone", K::Spot, [](Light& l) { l.innerCone = kNan; }},
        {"outerCone", K::Spot, [](Light& l) { l.outerCone = 1.6f; }},
        {"outerCone", K::Spot, [](Light& l) { l.outerCone = kNan; }},
    };
}

TEST_F(LightPack, RefusesEachBadFieldByName) {
    for (const BadLight& bad : badLights()) {
        Light light = bad.kind == LightKind::Triangle ? triangle(41) : of(bad.kind, 41);
        ASSERT_EQ(pack({light}), Status::Ok) << said_;
        bad.spoil(light);
        EXPECT_EQ(pack({triangle(3), light}), Status::InvalidArgument) << bad.field;
        EXPECT_NE(said_.find(bad.field), std::string::npos) << "expected " << bad.field << " in: " << said_;
        EXPECT_NE(said_.find("id " + std::to_string(light.id)), std::string::npos) << said_;
    }
}

// What a kind of light does not have is not looked at.
TEST_F(LightPack, IgnoresFieldsOfOtherKinds) {
    Light sun = of(LightKind::Directional, 0);
    sun.position[0] = sun.range = sun.vertex1[0] = sun.meanLuminance = kNan;
    Light bulb = of(LightKind::Point, 1);
    bulb.direction[0] = bulb.innerCone = bulb.uv[0][0] = kNan;
    EXPECT_EQ(pack({sun, bulb}), Status::Ok) << said_;
    EXPECT_NEAR(selectionSum(), 1, 1e-6);
}

TEST_F(LightPack, RefusesTwoLightsOfOneId) {
    EXPECT_EQ(pack({triangle(5), of(LightKind::Point, 5)}), Status::InvalidArgument);
    EXPECT_NE(said_.find("id 5"), std::string::npos) << said_;
}

TEST_F(LightPack, AnErrorChangesNothing) {
    ASSERT_EQ(pack({triangle(0), triangle(2, 3)}), Status::Ok);
    const PackedLights before = packed_;
    Light bad = triangle(1);
    bad.emission[0] = kNan;
    ASSERT_EQ(pack({triangle(7), bad}), Status::InvalidArgument);
    ASSERT_EQ(packed_.lights.size(), before.lights.size());
    ASSERT_EQ(packed_.alias.size(), before.alias.size());
    for (size_t i = 0; i < before.lights.size(); ++i)
        EXPECT_EQ(packed_.lights[i].selection, before.lights[i].selection);
}

TEST_F(LightPack, GapsInTheIdsHoldNoLight) {
    ASSERT_EQ(pack({triangle(6), triangle(2)}), Status::Ok);
    ASSERT_EQ(packed_.lights.size(), 7u);
    ASSERT_EQ(packed_.alias.size(), 7u);
    for (uint32_t id : {0u, 1u, 3u, 4u, 5u}) {
        EXPECT_EQ(at(id).kindAndTexture & RS_LIGHT_KIND_MASK, RS_LIGHT_NONE) << id;
        EXPECT_EQ(at(id).selection, 0) << id;
    }
    EXPECT_NEAR(double(at(2).selection), 0.5, 1e-6);
    EXPECT_NEAR(double(at(6).selection), 0.5, 1e-6);
}

TEST_F(LightPack, NoLightsAndBlackLights) {
    ASSERT_EQ(pack({}), Status::Ok);
    EXPECT_TRUE(packed_.lights.empty());
    EXPECT_TRUE(packed_.alias.empty());
    Light black = triangle(3);
    for (float& e : black.emission) e = 0;
    ASSERT_EQ(pack({black}), Status::Ok);
    EXPECT_TRUE(packed_.alias.empty());
    ASSERT_EQ(pack({black, triangle(1)}), Status::Ok);
    EXPECT_EQ(at(3).selection, 0);
    EXPECT_EQ(at(1).selection, 1);
}

TEST_F(LightPack, DegenerateTrianglesAreNeverDrawn) {
    Light line = triangle(0);
    for (int i = 0; i < 3; ++i) line.vertex2[i] = 2 * line.vertex1[i] - line.position[i];
    Light point = triangle(1, 0);
    ASSERT_EQ(pack({line, point, triangle(2)}), Status::Ok);
    EXPECT_EQ(at(0).selection, 0);
    EXPECT_EQ(at(1).selection, 0);
    EXPECT_EQ(at(2).selection, 1);
}

// Finite corners whose area is not.
TEST_F(LightPack, RefusesTrianglesTooLargeForTheShaders) {
    const Light infinite{
        .id = 0, .position = {-1e25f, 0, 0}, .vertex1 = {1e25f, 1e25f, 1e25f}, .vertex2 = {0, 0, -1e25f}};
    const Light undefined{.id = 0, .vertex1 = {1e25f, 1e25f, 1e25f}, .vertex2 = {1e25f, 2e25f, 3e25f}};
    for (const Light& huge : {infinite, undefined}) {
        EXPECT_EQ(pack({triangle(1), huge}), Status::InvalidArgument);
        EXPECT_NE(said_.find("id 0"), std::string::npos) << said_;
        EXPECT_NE(said_.find("vertex"), std::string::npos) << said_;
    }
}

TEST_F(LightPack, SelectionFollowsRadiantPower) {
    Light two = triangle(1);
    two.twoSided = true;
    Light textured = triangle(2);
    textured.texture = 4;
    textured.meanLuminance = 3;
    ASSERT_EQ(pack({triangle(0), two, textured, triangle(3, 2), of(LightKind::Point, 4)}), Status::Ok);
    EXPECT_NEAR(selectionSum(), 1, 1e-6);
    const double one = double(at(0).selection);
    EXPECT_NEAR(double(at(1).selection) / one, 2, 1e-5);
    EXPECT_NEAR(double(at(2).selection) / one, 3, 1e-5);
    EXPECT_NEAR(double(at(3).selection) / one, 4, 1e-5);
    EXPECT_NEAR(double(at(4).selection) / one, 4 / 0.5, 1e-5);   // 4 pi I against pi A L
}

TEST_F(LightPack, TriangleFields) {
    Light light = triangle(0, 2);
    light.twoSided = true;
    light.texture = 77;
    light.uv[1][0] = 0.25f;
    light.uv[2][1] = 0.75f;
    ASSERT_EQ(pack({light}), Status::Ok);
    EXPECT_EQ(at(0).kindAndTexture, RS_LIGHT_TRIANGLE | RS_LIGHT_TWO_SIDED | 77u << RS_LIGHT_TEXTURE_SHIFT);
    EXPECT_EQ(at(0).position.y, 2);
    EXPECT_EQ(at(0).edge1.x, 2);
    EXPECT_EQ(at(0).edge1.y, 0);
    EXPECT_EQ(at(0).edge2.y, 2);
    EXPECT_EQ(at(0).uv1.x, 0.25f);
    EXPECT_EQ(at(0).uv2.y, 0.75f);
    EXPECT_EQ(packed_.textures, 78u);
    ASSERT_EQ(pack({triangle(0)}), Status::Ok);
    EXPECT_EQ(packed_.textures, 0u);
    EXPECT_EQ(at(0).kindAndTexture >> RS_LIGHT_TEXTURE_SHIFT, RS_LIGHT_NO_TEXTURE);
}

// glTF's recommended spot attenuation: clamp(cos x scale + offset)^2 with 1 inside the inner cone, 0 outside
// the outer.
TEST_F(LightPack, SpotFields) {
    Light light = of(LightKind::Spot, 0);
    light.direction[0] = 3;
    light.direction[2] = -4;
    light.range = 12;
    light.innerCone = 0.3f;
    light.outerCone = 0.6f;
    ASSERT_EQ(pack({light}), Status::Ok);
    EXPECT_EQ(at(0).kindAndTexture & RS_LIGHT_KIND_MASK, RS_LIGHT_SPOT);
    EXPECT_FLOAT_EQ(at(0).edge1.x, 0.6f);
    EXPECT_FLOAT_EQ(at(0).edge1.z, -0.8f);
    EXPECT_EQ(at(0).edge2.z, 12);
    const auto cone = [&](double angle) {
        return std::cos(angle) * double(at(0).edge2.x) + double(at(0).edge2.y);
    };
    EXPECT_NEAR(cone(0.3), 1, 1e-5);
    EXPECT_NEAR(cone(0.6), 0, 1e-5);
}

TEST_F(LightPack, DirectionalFields) {
    Light light = of(LightKind::Directional, 0);
    light.direction[0] = 1e-20f;   // any length
    light.direction[1] = 1e-20f;
    light.direction[2] = 0;
    ASSERT_EQ(pack({light}), Status::Ok);
    EXPECT_EQ(at(0).kindAndTexture & RS_LIGHT_KIND_MASK, RS_LIGHT_DIRECTIONAL);
    EXPECT_FLOAT_EQ(at(0).edge1.x, 0.70710678f);
    EXPECT_FLOAT_EQ(at(0).edge1.y, 0.70710678f);
    EXPECT_EQ(at(0).selection, 1);
}

// `selection` is what drawing does, not what was asked for.
TEST_F(LightPack, SelectionIsTheTablesOwn) {
    std::vector<Light> lights;
    for (uint32_t id = 0; id < 50; ++id) lights.push_back(triangle(id, 0.1f + 0.37f * float(id % 11)));
    ASSERT_EQ(pack(lights), Status::Ok);
    std::vector<double> drawn(packed_.alias.size());
    for (size_t i = 0; i < drawn.size(); ++i) {
        const double keep = packed_.alias[i].threshold / 4294967296.0;
        drawn[i] += keep / 50;
        drawn[packed_.alias[i].alias] += (1 - keep) / 50;
    }
    for (uint32_t id = 0; id < 50; ++id) EXPECT_EQ(at(id).selection, float(drawn[id]));
    EXPECT_NEAR(selectionSum(), 1, 1e-6);
}

}   // namespace
