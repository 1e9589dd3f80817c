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
        return packer_.pack(sink, lights, lights_, packed_);
    }
    const restir::gpu::RsPackedLight& at(uint32_t id) const { return lights_[id]; }

    restir::LightPacker packer_{{.lights = kMaxLights, .textures = kMaxTextures, .environment = 12}};
    restir::gpu::RsPackedLight lights_[kMaxLights];
    PackedLights packed_;
    std::string said_;
};

Light triangle(uint32_t id, float size = 1) {
    return {.id = id, .position = {1, 2, 3}, .vertex1 = {1 + size, 2, 3}, .vertex2 = {1, 2 + size, 3}};
}
Light of(LightKind kind, uint32_t id) {
    Light light{.id = id, .kind = kind};
    if (kind == LightKind::Environment) light.texture = 0;
    return light;
}

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
        {"emission (above 1e30)", K::Environment, [](Light& l) { l.emission[2] = 3e38f; }},
        {"emission (above 1e30)", K::Sphere, [](Light& l) { l.emission[1] = 1.1e30f; }},
        {"position", K::Triangle, [](Light& l) { l.position[0] = kNan; }},
        {"position", K::Point, [](Light& l) { l.position[2] = kInfinity; }},
        {"position", K::Spot, [](Light& l) { l.position[1] = -kInfinity; }},
        {"vertex1", K::Triangle, [](Light& l) { l.vertex1[1] = kNan; }},
        {"vertex2", K::Triangle, [](Light& l) { l.vertex2[2] = kInfinity; }},
        {"meanLuminance", K::Triangle, [](Light& l) { l.meanLuminance = kNan; }},
        {"meanLuminance", K::Triangle, [](Light& l) { l.meanLuminance = kInfinity; }},
        {"meanLuminance", K::Rectangle, [](Light& l) { l.meanLuminance = 3e38f; }},
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
        {"angularRadius", K::Directional, [](Light& l) { l.angularRadius = -0.1f; }},
        {"angularRadius", K::Directional, [](Light& l) { l.angularRadius = 1.6f; }},
        {"radius", K::Sphere, [](Light& l) { l.radius = -1; }},
        {"radius", K::Capsule, [](Light& l) { l.radius = kNan; }},
        {"radius", K::Disk, [](Light& l) { l.radius = kInfinity; }},
        {"position", K::Sphere, [](Light& l) { l.position[1] = kNan; }},
        {"vertex1", K::Capsule, [](Light& l) { l.vertex1[2] = kInfinity; }},
        {"vertex1", K::Capsule, [](Light& l) { l.vertex1[2] = 1e20f; }},
        {"vertex2", K::Rectangle, [](Light& l) { l.vertex2[0] = kNan; }},
        {"direction", K::Disk, [](Light& l) { l.direction[2] = 0; }},
        {"texture", K::Rectangle, [](Light& l) { l.texture = kMaxTextures; }},
        {"texture", K::Environment, [](Light& l) { l.texture = RS_NO_TEXTURE; }},
        {"rotation", K::Environment, [](Light& l) { l.rotation[1] = 0.5f; }},
        {"rotation", K::Environment, [](Light& l) { l.rotation[3] = kNan; }},
        {"texture", K::Point, [](Light& l) { l.texture = kMaxTextures; }},
        {"rotation", K::Spot, [](Light& l) { l.texture = 1, l.rotation[0] = 0.5f; }},
        {"rotation", K::Spot,
         [](Light& l) {
             l.texture = 1;
             l.direction[0] = 1;
             l.direction[2] = 0;
         }},
        {"meanLuminance", K::Point, [](Light& l) { l.texture = 1, l.meanLuminance = kNan; }},
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
    bulb.direction[0] = bulb.innerCone = bulb.uv[0][0] = bulb.radius = kNan;
    bulb.meanLuminance = bulb.rotation[0] = kNan;   // it has no profile
    sun.texture = kMaxTextures;
    Light ball = of(LightKind::Sphere, 2);
    ball.direction[0] = ball.vertex1[0] = ball.rotation[0] = ball.angularRadius = kNan;
    EXPECT_EQ(pack({sun, bulb, ball}), Status::Ok) << said_;
    EXPECT_EQ(packed_.textures, 0u);
}

TEST_F(LightPack, RefusesTwoLightsOfOneId) {
    EXPECT_EQ(pack({triangle(5), of(LightKind::Point, 5)}), Status::InvalidArgument);
    EXPECT_NE(said_.find("id 5"), std::string::npos) << said_;
}

TEST_F(LightPack, AnErrorChangesNothingOfWhatIsSaid) {
    ASSERT_EQ(pack({triangle(0), triangle(2, 3)}), Status::Ok);
    Light bad = triangle(1);
    bad.emission[0] = kNan;
    ASSERT_EQ(pack({triangle(7), bad}), Status::InvalidArgument);
    EXPECT_EQ(packed_.count, 3u);
    // Nor does it keep ids from being used.
    EXPECT_EQ(pack({triangle(7), triangle(1)}), Status::Ok) << said_;
    EXPECT_EQ(packed_.count, 8u);
}

TEST_F(LightPack, ChecksWithoutPacking) {
    ASSERT_EQ(pack({triangle(0)}), Status::Ok);
    const float was = at(0).edge1.x;
    const std::vector<Light> good{triangle(0, 9), triangle(5)}, bad{triangle(5), triangle(5)};
    EXPECT_EQ(packer_.pack({}, good, nullptr, packed_), Status::Ok);
    EXPECT_EQ(packed_.count, 6u);
    EXPECT_EQ(packer_.pack({}, bad, nullptr, packed_), Status::InvalidArgument);
    EXPECT_EQ(at(0).edge1.x, was);
}

TEST_F(LightPack, GapsInTheIdsHoldNoLight) {
    for (auto& light : lights_) light.kindAndTexture = RS_LIGHT_POINT;   // of another upload
    ASSERT_EQ(pack({triangle(6), triangle(2)}), Status::Ok);
    ASSERT_EQ(packed_.count, 7u);
    for (uint32_t id = 0; id < kMaxLights; ++id) {
        const uint32_t expected = id > 6               ? RS_LIGHT_POINT
                                  : id == 2 || id == 6 ? RS_LIGHT_TRIANGLE
                                                       : RS_LIGHT_NONE;
        EXPECT_EQ(at(id).kindAndTexture & RS_LIGHT_KIND_MASK, expected) << id;
    }
    ASSERT_EQ(pack({triangle(63)}), Status::Ok);
    EXPECT_EQ(at(6).kindAndTexture, RS_LIGHT_NONE);
    EXPECT_EQ(at(63).kindAndTexture & RS_LIGHT_KIND_MASK, RS_LIGHT_TRIANGLE);
}

TEST_F(LightPack, NoLights) {
    ASSERT_EQ(pack({}), Status::Ok);
    EXPECT_EQ(packed_.count, 0u);
    EXPECT_FALSE(packed_.infinite);
    ASSERT_EQ(pack({triangle(3), of(LightKind::Directional, 1)}), Status::Ok);
    EXPECT_TRUE(packed_.infinite);
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

// By which it is chosen: restir/lights/power.glsl.
TEST_F(LightPack, MeanLuminance) {
    Light textured = triangle(0);
    textured.texture = 4;
    textured.meanLuminance = 3;
    Light green = triangle(1), bulb = of(LightKind::Point, 2);
    green.emission[0] = green.emission[2] = 0;
    bulb.meanLuminance = 7;   // a triangle's
    ASSERT_EQ(pack({textured, green, bulb}), Status::Ok);
    EXPECT_EQ(at(0).selection, 3);
    EXPECT_FLOAT_EQ(at(1).selection, 0.7152f);
    EXPECT_FLOAT_EQ(at(2).selection, 1);
}

TEST_F(LightPack, LightsAtInfinity) {
    Light sun = of(LightKind::Directional, 3);
    Light sky = of(LightKind::Environment, 5);
    for (float& e : sky.emission) e = 0.5f;
    ASSERT_EQ(pack({sun, sky, triangle(0)}), Status::Ok) << said_;
    EXPECT_FLOAT_EQ(at(5).selection, 6);   // times the map's integral
    EXPECT_EQ(packed_.found[0], 5u);       // the sun is a point
    EXPECT_EQ(packed_.found[1], RS_NO_LIGHT);
    sun.angularRadius = 0.01f;
    ASSERT_EQ(pack({sun, sky}), Status::Ok) << said_;
    EXPECT_EQ(packed_.found[0], 3u);
    EXPECT_EQ(packed_.found[1], 5u);
    std::vector<Light> suns;
    for (uint32_t id = 0; id < 5; ++id) {
        suns.push_back(sun);
        suns.back().id = id;
    }
    EXPECT_EQ(pack(suns), Status::InvalidArgument);
    EXPECT_NE(said_.find("light 4 (id 4): more than 4 lights at infinity"), std::string::npos) << said_;
    packer_.environmentHas(-1);
    EXPECT_EQ(pack({sky}), Status::InvalidArgument);
    EXPECT_NE(said_.find("uploadEnvironment"), std::string::npos) << said_;
    packer_.environmentHas(0);   // a black map
    ASSERT_EQ(pack({sky}), Status::Ok) << said_;
    EXPECT_EQ(at(5).selection, 0);
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
}

}   // namespace
