// Every kind of light over a plane, against closed forms; the odd ones; lights that come and go. With a single
// light without extent nothing is random, so those pictures are compared pixel by pixel.
#include <gtest/gtest.h>

#include <optional>

#include "image/host_view.h"
#include "image/hypothesis.h"
#include "image/stage.h"
#include "image/world.h"

namespace tests {
namespace {

using restir::Light;
using restir::LightKind;

constexpr VkExtent2D kExtent{32, 32};
constexpr uint32_t kFrames = 4;
// 16-bit normals, positions rebuilt from depth.
constexpr double kRounding = 5e-4;

void set(float (&to)[3], glm::vec3 v) {
    for (int i = 0; i < 3; ++i) to[i] = v[i];
}

Light pointLight(uint32_t id, glm::vec3 position, glm::vec3 intensity) {
    Light light{.id = id, .kind = LightKind::Point};
    set(light.position, position);
    set(light.emission, intensity);
    return light;
}

Light randomLight(uint32_t id, samples::build::Rng& rng) {
    const glm::vec3 position{rng.range(-1, 1), rng.range(0.5f, 2), rng.range(-2, 0.5f)};
    return pointLight(id, position, {rng.range(0.1f, 2), rng.range(0.1f, 2), rng.range(0.1f, 2)});
}

glm::dvec3 vec(const float (&v)[3]) { return {double(v[0]), double(v[1]), double(v[2])}; }

// KHR_lights_punctual, on the plane.
glm::dvec3 irradiance(const Light& light, glm::dvec3 p) {
    const glm::dvec3 emission = vec(light.emission);
    const glm::dvec3 travels = glm::normalize(vec(light.direction));
    if (light.kind == LightKind::Directional) return emission * std::max(-travels.y, 0.0);
    const glm::dvec3 d = vec(light.position) - p;
    const double distance = glm::length(d);
    double falloff = d.y / (distance * distance * distance);
    if (light.range > 0) falloff *= glm::clamp(1 - std::pow(distance / double(light.range), 4.0), 0.0, 1.0);
    if (light.kind == LightKind::Spot) {
        const double outer = std::cos(double(light.outerCone)), inner = std::cos(double(light.innerCone));
        const double cone = glm::clamp((glm::dot(travels, -d / distance) - outer) / (inner - outer), 0.0, 1.0);
        falloff *= cone * cone;
    }
    return emission * falloff;
}

// The plane, a blocker that covers a square of the sky, and no light of its own.
samples::SceneData darkScene(bool blocker) {
    samples::SceneData scene = planeScene();
    if (blocker) addQuad(scene, lamp({0, 0.95f, -0.3f}, 0.25f), {.color = {0, 0, 0}, .specular = 0});
    return scene;
}
bool behindBlocker(const Light& light, glm::dvec3 p, double half) {
    const glm::dvec3 d = light.kind == LightKind::Directional ? -vec(light.direction) : vec(light.position) - p;
    const glm::dvec3 at = p + d * (0.95 / d.y);
    return std::abs(at.x) < half && std::abs(at.z + 0.3) < half;
}

class Lights : public testing::Test {
protected:
    explicit Lights(bool blocker = false) {
        samples::SceneData data = darkScene(blocker);
        view = data.views[0];
        scene = std::make_unique<samples::GpuScene>(device(), std::move(data));
        host = std::make_unique<HostView>(*scene, view, HostDesc{.maxExtent = kExtent, .maxLights = 64});
    }
    samples::FloatImage truth(const std::vector<Light>& lights) const {
        return planePicture(view, kExtent, 1, [&](glm::dvec3 p) {
            glm::dvec3 sum(0);
            for (const Light& light : lights) sum += irradiance(light, p);
            return sum;
        });
    }
    // Frames from `first` on of the plane lit by `lights`.
    samples::FloatImage picture(const std::vector<Light>& lights, uint32_t first = 0, uint32_t seed = 0) {
        host->upload(lights);
        const samples::FloatImage image = host->frames(first, kFrames, unbiased(), seed);
        EXPECT_TRUE(allFinite(image));
        return image;
    }

    samples::View view;
    std::unique_ptr<samples::GpuScene> scene;
    std::unique_ptr<HostView> host;
};

std::vector<Light> oneOfEach() {
    Light spot{.id = 1, .kind = LightKind::Spot, .innerCone = 0.1f, .outerCone = 0.5f};
    set(spot.position, {0.3f, 1.2f, -0.4f});
    set(spot.direction, {-0.2f, -3, 0.1f});
    set(spot.emission, {4, 5, 6});
    Light directional{.id = 2, .kind = LightKind::Directional};
    set(directional.direction, {0.3f, -2, -0.5f});
    set(directional.emission, {3, 2, 1});
    Light ranged = pointLight(3, {-0.3f, 1.5f, 0.2f}, {1, 2, 3});
    ranged.range = 1.9f;
    return {pointLight(0, {0.4f, 1.3f, -0.5f}, {2, 3, 4}), spot, directional, ranged};
}

TEST_F(Lights, EachKindIsItsClosedForm) {
    for (const Light& light : oneOfEach()) {
        SCOPED_TRACE(light.id);
        EXPECT_LT(largestDifference(picture({light}), truth({light})), kRounding);
    }
}

TEST_F(Lights, ExposureMultipliesTheOutput) {
    const std::vector<Light> lights{oneOfEach()[0]};
    const samples::FloatImage once = picture(lights);
    restir::FrameInput input = host->input(kFrames);
    input.exposure = 4;
    samples::FloatImage times4 = host->frame(input, unbiased());
    for (float& v : times4.rgb) v /= 4;
    EXPECT_LT(largestDifference(times4, once), 1e-6);
}

TEST_F(Lights, NoneIsBlack) { EXPECT_EQ(largest(picture({})), 0); }

TEST_F(Lights, BlackAndDegenerateOnesAddNothing) {
    Light flat{.id = 6};   // a triangle of a single point
    Light needle{.id = 7};
    set(needle.position, {0, 1, 0});
    set(needle.vertex1, {0, 1, 1});
    set(needle.vertex2, {0, 1, 2});
    const Light black = pointLight(5, {0, 1, 0}, {0, 0, 0});
    const Light lit = oneOfEach()[0];
    EXPECT_EQ(largest(picture({black})), 0);
    EXPECT_EQ(largest(picture({flat, needle, black})), 0);
    EXPECT_LT(largestDifference(picture({black, flat, needle, lit}), truth({lit})), kRounding);
}

TEST_F(Lights, HugeRangeOfPowers) {
    const Light faint = pointLight(0, {0.3f, 1, 0}, glm::vec3(1e-20f));
    const Light strong = pointLight(1, {0, 1, 0}, glm::vec3(1e20f));
    EXPECT_LT(largestDifference(picture({faint}), truth({faint})), kRounding);
    EXPECT_LT(largestDifference(picture({strong}), truth({strong})), kRounding);
    EXPECT_LT(largestDifference(picture({faint, strong}), truth({strong})), kRounding);
}

// Lies in the plane and shines away from it: no point of the plane sees its front.
TEST_F(Lights, CoplanarOneDoesNotLightItsPlane) {
    Light coplanar{.id = 0, .twoSided = true};
    set(coplanar.position, {-0.5f, 0, 0.2f});
    set(coplanar.vertex1, {0.5f, 0, 0.2f});
    set(coplanar.vertex2, {0, 0, -0.6f});
    set(coplanar.emission, {100, 100, 100});
    EXPECT_LT(largest(picture({coplanar})), 1e-3f);
}

TEST_F(Lights, AnotherLightTakesOver) {
    const Light first = pointLight(0, {0.5f, 1, 0}, {9, 1, 1});
    const Light second = pointLight(1, {-0.4f, 1.5f, -0.3f}, {1, 1, 9});
    EXPECT_LT(largestDifference(picture({first}), truth({first})), kRounding);
    EXPECT_LT(largestDifference(picture({second}, kFrames), truth({second})), kRounding);
    EXPECT_EQ(largest(picture({}, 2 * kFrames)), 0);
    EXPECT_LT(largestDifference(picture({first}, 3 * kFrames), truth({first})), kRounding);
}

TEST_F(Lights, MovingOneKeepsItsId) {
    for (uint32_t step = 0; step < 4; ++step) {
        const Light light = pointLight(3, {-0.6f + 0.4f * float(step), 1, 0}, glm::vec3(float(1 + step)));
        host->upload(std::vector{light});
        EXPECT_LT(largestDifference(host->frames(step, 1, unbiased()), truth({light})), kRounding) << step;
    }
}

// 40 slots; a slot that was free last frame gets a new light with probability one half, one in use loses it
// likewise: ids name other lights after one upload without them, as the contract says.
TEST_F(Lights, ChurnOfIdsStaysUnbiased) {
    constexpr uint32_t kPictures = 448, kSlots = 40, kChurn = 5;
    SeedStatistics statistics;
    samples::FloatImage expected;
    for (uint32_t seed = 1; seed <= kPictures; ++seed) {
        samples::build::Rng rng(77);   // the same lights in every sequence
        std::vector<std::optional<Light>> slots(kSlots);
        std::vector<Light> lights;
        for (uint32_t frame = 0; frame < kChurn; ++frame) {
            lights.clear();
            for (uint32_t id = 0; id < kSlots; ++id) {
                const Light another = randomLight(id, rng);
                if (rng.below(2) == 0) slots[id] = slots[id] ? std::nullopt : std::optional(another);
                if (slots[id]) lights.push_back(*slots[id]);
            }
            host->upload(lights);
            restir::FrameInput input = host->input(frame);
            input.seed = seed;
            input.resetHistory = frame == 0;
            const samples::FloatImage image = host->frame(input, unbiased());
            ASSERT_TRUE(allFinite(image));
            if (frame + 1 == kChurn) statistics.add(image);
        }
        expected = truth(lights);
    }
    Verdict verdict(1, kPictures);
    verdict.add("churn", compare(statistics, exactly(expected)));
}

class BlockedLights : public Lights {
protected:
    BlockedLights() : Lights(true) {}
};

TEST_F(BlockedLights, EachKindCastsItsShadow) {
    for (const Light& light : oneOfEach()) {
        SCOPED_TRACE(light.id);
        const samples::FloatImage image = picture({light}), open = truth({light});
        const samples::CameraPose pose = samples::makePose(view, kExtent);
        uint32_t shadowed = 0, lit = 0;
        for (uint32_t i = 0; i < kExtent.width * kExtent.height; ++i) {
            glm::dvec3 point;
            ASSERT_TRUE(planePoint(pose, kExtent, glm::dvec2(i % kExtent.width, i / kExtent.width) + 0.5, point));
            if (behindBlocker(light, point, 0.249)) {
                ++shadowed;
                EXPECT_EQ(image.rgb[3 * i], 0) << i;
            } else if (!behindBlocker(light, point, 0.251)) {
                ++lit;
                EXPECT_NEAR(image.rgb[3 * i], open.rgb[3 * i], kRounding * double(largest(open))) << i;
            }
        }
        EXPECT_GT(shadowed, 20u);
        EXPECT_GT(lit, 200u);
    }
}

}   // namespace
}   // namespace tests
