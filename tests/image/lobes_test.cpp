// Output::diffuse and Output::specular, and those of indirect light: put together again they are the
// radiance, and their hit distance is the light's.
#include <gtest/gtest.h>

#include <numbers>

#include "image/host_view.h"
#include "image/hypothesis.h"
#include "image/stage.h"
#include "image/world.h"

namespace tests {
namespace {

using restir::Light;
using restir::LightKind;

constexpr VkExtent2D kExtent{32, 24};
constexpr size_t kPixels = kExtent.width * kExtent.height;
constexpr float kEmpty = -1;
constexpr double kRounding = 1e-5;
constexpr double kRayOrigin =
    5e-4;   // rays start off the surface; 16-bit normals, positions rebuilt from depth

// The plane with another material in each pixel, all of them exact in their packed form; the first column is
// empty.
struct Materials {
    std::vector<glm::vec4> depth, normal, color, material, emission;
    std::vector<glm::dvec3> point;

    explicit Materials(const samples::CameraPose& pose) {
        samples::build::Rng rng(5);
        const auto level = [&](uint32_t largest) { return float(rng.below(largest + 1)) / float(largest); };
        for (size_t i = 0; i < kPixels; ++i) {
            glm::dvec3 at;
            EXPECT_TRUE(
                planePoint(pose, kExtent, glm::dvec2(i % kExtent.width, i / kExtent.width) + 0.5, at));
            point.push_back(at);
            depth.emplace_back(i % kExtent.width == 0 ? kEmpty
                                                      : glm::dot(glm::vec3(at) - pose.eye, pose.forward));
            normal.emplace_back(0, 1, 0, 0);
            glm::vec4 base{level(1023), level(1023), level(1023), 0};
            base *= base;
            if (i % 5 == 0) base[int(i / 5 % 3)] = 0;
            if (i % 7 == 0) base = glm::vec4(0);
            color.push_back(base);
            const float metalness = i % 3 == 0 ? level(255) : i % 3 == 1 ? 1.0f : 0.0f;
            material.emplace_back(level(255), metalness, i % 4 == 0 ? 0 : level(255), 0);
            emission.emplace_back(i % 2 == 0 ? glm::vec4(0) : glm::vec4(0.5f, 0.25f, 1, 0));
        }
    }
    bool empty(size_t i) const { return depth[i].x == kEmpty; }
    glm::dvec3 albedo(size_t i) const { return (1.0 - double(material[i].y)) * glm::dvec3(color[i]); }
    glm::dvec3 factor(size_t i) const {
        const glm::dvec3 dielectric(0.04 * double(material[i].z));
        return glm::max(glm::mix(dielectric, glm::dvec3(color[i]), double(material[i].y)), 0.01);
    }
};

Light light(uint32_t id, LightKind kind, glm::vec3 position, glm::vec3 emission) {
    return {.id = id,
            .kind = kind,
            .position = {position.x, position.y, position.z},
            .direction = {0.1f, -1, 0.2f},
            .emission = {emission.x, emission.y, emission.z}};
}
std::vector<Light> severalLights() {
    return {light(0, LightKind::Point, {0.4f, 1.3f, -0.5f}, {2, 3, 4}),
            light(1, LightKind::Point, {-0.6f, 0.7f, 0.1f}, {3, 1, 1}),
            light(2, LightKind::Directional, {}, {1, 1, 0}),
            light(3, LightKind::Point, {0, 2, -1}, {0, 0, 5})};
}

class Lobes : public testing::Test {
protected:
    Lobes() : Lobes(planeScene()) {}
    explicit Lobes(samples::SceneData data)
        : scene(device(), std::move(data)),
          host(scene, planeScene().views[0],
               {.maxExtent = kExtent,
                .maxLights = 8,
                .allOutputs = true,
                .pairedNeighbours = 5,
                .indirect = true}),
          surfaces(samples::makePose(planeScene().views[0], kExtent)),
          depth(floatImage(kExtent, surfaces.depth)),
          normal(floatImage(kExtent, surfaces.normal)),
          color(floatImage(kExtent, surfaces.color)),
          material(floatImage(kExtent, surfaces.material)),
          emission(floatImage(kExtent, surfaces.emission)) {
        settings.di.normalThreshold = -1;
    }
    restir::FrameInput input(uint32_t index) const {
        restir::FrameInput in = host.input(index);
        in.exposure = kExposure;
        in.output.gradient = VK_NULL_HANDLE;
        in.gbuffer = {.depth = {depth.view()},
                      .normal = {normal.view()},
                      .baseColor = {color.view()},
                      .material = {material.view()},
                      .emission = {emission.view()},
                      .normals = restir::NormalEncoding::Xyz,
                      .depthKind = restir::DepthKind::Linear,
                      .emptyDepth = kEmpty};
        in.resetHistory = index == 0;
        return in;
    }
    // Three frames; the last one is read.
    void render() {
        for (uint32_t i = 0; i < 3; ++i) image = host.frame(input(i), settings);
        diffuse = host.read(2, Target::Diffuse);
        specular = host.read(2, Target::Specular);
    }
    void expectWhole(const std::string& name) const {
        double lit = 0;
        for (size_t i = 0; i < kPixels; ++i) {
            const glm::dvec3 radiance(image.rgb[3 * i], image.rgb[3 * i + 1], image.rgb[3 * i + 2]);
            glm::dvec3 sum =
                glm::dvec3(diffuse[i]) * surfaces.albedo(i) + glm::dvec3(specular[i]) * surfaces.factor(i);
            lit += sum.x + sum.y + sum.z;
            if (!surfaces.empty(i)) sum += double(kExposure) * glm::dvec3(surfaces.emission[i]);
            for (int c = 0; c < 3; ++c)
                ASSERT_NEAR(sum[c], radiance[c], kRounding * std::max(radiance[c], 1e-3)) << name << " " << i;
            if (surfaces.empty(i) || surfaces.albedo(i) == glm::dvec3(0)) {
                ASSERT_EQ(diffuse[i], glm::vec4(0)) << name << " " << i;
            }
            if (surfaces.empty(i)) {
                ASSERT_EQ(specular[i], glm::vec4(0)) << name << " " << i;
            }
        }
        EXPECT_GT(lit, 1) << name;
    }

    static constexpr float kExposure = 2;
    samples::GpuScene scene;
    HostView host;
    Materials surfaces;
    samples::GpuImage depth, normal, color, material, emission;
    restir::Settings settings = unbiased();
    samples::FloatImage image;
    std::span<const glm::vec4> diffuse, specular;
};

// Each pass that writes outputs: the mean of a spatial pass, the shading of one sample, next-event
// estimation.
TEST_F(Lobes, PutTogetherTheyAreTheRadiance) {
    host.upload(severalLights());
    std::vector<NamedSettings> all = unbiasedSettings();
    for (NamedSettings& half : checkerboards()) all.push_back(std::move(half));
    for (const NamedSettings& named : all) {
        settings.di = named.settings.di;
        settings.di.normalThreshold = -1;
        render();
        expectWhole(named.name);
    }
    settings = unbiased();
    settings.di.weights = restir::Weights::Off;
    render();
    expectWhole("off");
}

TEST_F(Lobes, DiffuseIsIrradianceOverPi) {
    for (glm::vec4& m : surfaces.material) m = {1, 0, 0, 0};
    material = floatImage(kExtent, surfaces.material);
    const Light lamp = severalLights()[0];
    host.upload({&lamp, 1});
    render();
    for (size_t i = 0; i < kPixels; ++i) {
        ASSERT_EQ(specular[i], glm::vec4(0)) << i;
        if (surfaces.empty(i) || surfaces.albedo(i) == glm::dvec3(0)) continue;
        const glm::dvec3 to = glm::dvec3(0.4f, 1.3f, -0.5f) - surfaces.point[i];
        const double scale = double(kExposure) * to.y / std::pow(glm::length(to), 3.0) / std::numbers::pi;
        for (int c = 0; c < 3; ++c)
            ASSERT_NEAR(diffuse[i][c], scale * double(2 + c), kRayOrigin * scale * 4) << i;
    }
}

TEST_F(Lobes, HitDistanceIsTheLights) {
    const Light lamp = severalLights()[0], sun = severalLights()[2];
    host.upload({&lamp, 1});
    render();
    for (size_t i = 0; i < kPixels; ++i) {
        const double distance = glm::distance(glm::dvec3(0.4f, 1.3f, -0.5f), surfaces.point[i]);
        for (const glm::vec4& lobe : {diffuse[i], specular[i]})
            ASSERT_NEAR(lobe.w, lobe.x + lobe.y + lobe.z > 0 ? distance : 0, 1e-3) << i;
    }
    host.upload({&sun, 1});
    render();
    for (size_t i = 0; i < kPixels; ++i)
        for (const glm::vec4& lobe : {diffuse[i], specular[i]})
            ASSERT_NEAR(lobe.w, lobe.x + lobe.y > 0 ? 65504 : 0, 0.1) << i;
}

// Of the two lamps that make up the mean, one is red and one is blue: their shares are in the colour.
TEST_F(Lobes, HitDistanceIsWeightedByWhatLightsContribute) {
    const Light red = light(0, LightKind::Point, {0.4f, 1.3f, -0.5f}, {5, 0, 0});
    const Light blue = light(1, LightKind::Point, {-0.6f, 0.7f, 0.1f}, {0, 0, 9});
    host.upload(std::vector{red, blue});
    render();
    size_t mixed = 0;
    for (size_t i = 0; i < kPixels; ++i) {
        const double r = 0.2126 * double(diffuse[i].x), b = 0.0722 * double(diffuse[i].z);
        if (!(r > 0 && b > 0)) continue;
        ++mixed;
        const double far = glm::distance(glm::dvec3(0.4f, 1.3f, -0.5f), surfaces.point[i]);
        const double near = glm::distance(glm::dvec3(-0.6f, 0.7f, 0.1f), surfaces.point[i]);
        ASSERT_NEAR(diffuse[i].w, (r * far + b * near) / (r + b), 1e-3) << i;
    }
    EXPECT_GT(mixed, 50u);
}

constexpr float kCeiling = 1.9f;

// The plane under a ceiling, which is what lights it: part of what that reflects changes with the direction.
class IndirectLobes : public Lobes {
protected:
    IndirectLobes() : Lobes(underCeiling()) {
        settings.di.mode = restir::DirectMode::Off;
        settings.gi.bounces = 2;
        settings.gi.normalThreshold = -1;
        emission = floatImage(
            kExtent, std::vector<glm::vec4>(kPixels, glm::vec4(0)));   // or rounding would be all there is
        host.upload(severalLights());
    }
    static samples::SceneData underCeiling() {
        samples::SceneData data = planeScene();
        addQuad(data, lamp({0, kCeiling, 0}, 4),
                {.color = kAlbedo, .roughness = 77.0f / 255.0f, .metalness = 51.0f / 255.0f});
        return data;
    }
    void render() {
        for (uint32_t i = 0; i < 3; ++i) {
            restir::FrameInput in = input(i);
            host.addIndirectLobes(in);
            image = host.frame(in, settings);
        }
        diffuse = host.read(2, Target::IndirectDiffuse);
        specular = host.read(2, Target::IndirectSpecular);
    }
    // The radiance is rounded at random by up to 1/128 of its largest channel, each of the two times that
    // light is added to it.
    void expectWhole(const std::string& name) const {
        double light = 0, difference = 0, variance = 0;
        for (size_t i = 0; i < kPixels; ++i) {
            if (surfaces.empty(i)) {
                ASSERT_EQ(diffuse[i], glm::vec4(0)) << name << " " << i;
                ASSERT_EQ(specular[i], glm::vec4(0)) << name << " " << i;
                continue;
            }
            const glm::dvec3 sum =
                glm::dvec3(diffuse[i]) * surfaces.albedo(i) + glm::dvec3(specular[i]) * surfaces.factor(i);
            const double largest = std::max({std::abs(sum.x), std::abs(sum.y), std::abs(sum.z)});
            for (int c = 0; c < 3; ++c) {
                const double off = double(image.rgb[3 * i + size_t(c)]) - sum[c];
                ASSERT_LE(std::abs(off), 4.0 / 128 * largest + 1e-4) << name << " " << i;
                light += sum[c];
                difference += off;
                variance += 2 * std::pow(largest / 128, 2) / 4;
            }
        }
        EXPECT_GT(light, 1) << name;
        EXPECT_LE(std::abs(difference), 5 * std::sqrt(variance))
            << name << " of " << light;   // rounding does not bias
        EXPECT_LE(5 * std::sqrt(variance), 0.01 * light) << name;
    }
    void expectDistances(const std::string& name) const {
        for (size_t i = 0; i < kPixels; ++i)
            for (const glm::vec4& lobe : {diffuse[i], specular[i]}) {
                if (glm::vec3(lobe) == glm::vec3(0))
                    ASSERT_EQ(lobe.w, 0) << name << " " << i;
                else
                    ASSERT_GT(double(lobe.w), kCeiling - 0.01 - surfaces.point[i].y) << name << " " << i;
            }
    }
};

// Each pass that shades indirect light: the path alone, the mean of a spatial pass, the one sample that was
// kept.
TEST_F(IndirectLobes, PutTogetherTheyAreTheRadiance) {
    const auto expect = [&](const std::string& name) {
        render();
        expectWhole(name);
        expectDistances(name);
    };
    settings.gi.mode = restir::IndirectMode::Path;
    expect("path");
    settings.gi.mode = restir::IndirectMode::Restir;
    expect("mean");
    settings.gi.checkerboard = true;
    expect("checkerboard");
    settings.gi.checkerboard = false;
    settings.gi.pairedNeighbours = true;
    expect("paired");
    settings.gi.pairedNeighbours = false;
    settings.gi.averageShading = false;
    expect("selected");
    settings.gi.spatialPasses = 2;
    settings.gi.visibility = restir::VisibilityReuse::Cached;
    expect("two passes, cached");
    settings.gi.temporal = false;
    settings.gi.spatialPasses = 0;
    expect("candidates");
}

// Their scratch is the direct light's buffer.
TEST_F(IndirectLobes, DirectLightIsTheSameWithThem) {
    settings.di.mode = restir::DirectMode::Restir;
    settings.gi.mode = restir::IndirectMode::Restir;
    settings.gi.checkerboard = true;
    render();
    const samples::FloatImage with = image;
    host.newSession();
    Lobes::render();
    EXPECT_EQ(image.rgb, with.rgb);
}

TEST_F(Lobes, RadianceIsTheSameWithoutThem) {
    host.upload(severalLights());
    render();
    host.newSession();
    samples::FloatImage without;
    for (uint32_t i = 0; i < 3; ++i) {
        restir::FrameInput in = input(i);
        in.output.diffuse = in.output.specular = VK_NULL_HANDLE;
        without = host.frame(in, settings);
    }
    EXPECT_EQ(without.rgb, image.rgb);
}

}   // namespace
}   // namespace tests
