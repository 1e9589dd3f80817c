// Output::gradient under point lights over the plane, where both numbers are known.
#include <gtest/gtest.h>

#include "image/host_view.h"
#include "image/hypothesis.h"
#include "image/stage.h"
#include "image/world.h"

namespace tests {
namespace {

using restir::Light;

constexpr VkExtent2D kExtent{24, 24};
constexpr uint32_t kMaxHistory = 4;
constexpr double kRounding = 1e-6;   // of two evaluations that a compiler may order differently

Light light(uint32_t id, float x, float power) {
    return {
        .id = id, .kind = restir::LightKind::Point, .position = {x, 1, 0}, .emission = {power, power, power}};
}

class Gradient : public testing::Test {
protected:
    Gradient()
        : scene(device(), planeScene()), host(scene, planeScene().views[0], {kExtent, 8, {}, 0, true}) {
        settings.di.maxHistory = kMaxHistory;
        settings.di.cutSamples = 1;
        settings.di.bsdfCandidates = 0;   // the blocker of one test is not in the scene's tables
    }
    std::span<const glm::vec4> frame(const std::function<void(restir::FrameInput&)>& change = {}) {
        restir::FrameInput input = host.input(next++);
        if (change) change(input);
        EXPECT_TRUE(allFinite(host.frame(input, settings)));
        return host.read(input.frameSlot, Target::Gradient);
    }
    static void expect(std::span<const glm::vec4> pixels, float gradient, const char* when) {
        for (const glm::vec4& pixel : pixels) ASSERT_NEAR(pixel.y, gradient, 1e-5f) << when;
    }
    // Filtered over the picture.
    static double mean(std::span<const glm::vec4> pixels) {
        double change = 0, whole = 0;
        for (const glm::vec4& pixel : pixels) {
            change += double(pixel.z);
            whole += double(pixel.w);
        }
        return change / whole;
    }

    samples::GpuScene scene;
    HostView host;
    restir::Settings settings = unbiased();
    uint32_t next = 0;
};

TEST_F(Gradient, StaticSceneLeavesItAtZero) {
    host.upload(std::vector{light(1, -0.4f, 1), light(2, 0.4f, 2)});
    for (uint32_t i = 0; i < kMaxHistory; ++i) {
        const auto pixels = frame();
        expect(pixels, i == 0 ? 1 : 0, "static");   // of the first frame all light is new
        for (const glm::vec4& pixel : pixels)
            ASSERT_TRUE(pixel.x >= float(i > 0 ? 2 : 1) && pixel.x <= kMaxHistory + 1) << i;
    }
    settings.di.spatialPasses = 0;   // neighbours count in M, too
    for (uint32_t i = 0; i < kMaxHistory + 3; ++i) {
        const auto pixels = frame([i](restir::FrameInput& input) { input.resetHistory = i == 0; });
        expect(pixels, i == 0 ? 1 : 0, "cut, then static");
        for (const glm::vec4& pixel : pixels) ASSERT_EQ(pixel.x, float(std::min(i, kMaxHistory) + 1)) << i;
    }
    settings.di.temporal = false;   // the last frame is known all the same
    const auto pixels = frame();
    expect(pixels, 0, "without temporal reuse");
    for (const glm::vec4& pixel : pixels) ASSERT_EQ(pixel.x, 1);
}

TEST_F(Gradient, TellsByHowMuchALightChanges) {
    const auto set = [&](const std::vector<Light>& lights, float expected, const char* when) {
        host.upload(lights);
        expect(frame(), expected, when);
        expect(frame(), 0, "after it");
    };
    host.upload(std::vector{light(1, 0.2f, 1)});
    frame();
    set({light(1, 0.2f, 0.25f)}, 0.75f, "dimmed");
    set({light(1, 0.2f, 0.5f)}, 0.5f, "brightened");
    set({light(1, 0.2f, 0)}, 1, "black");
    set({light(1, 0.2f, 1)}, 1, "lit");
    set({}, 1, "gone");
    set({light(2, 0.2f, 1)}, 1, "there");
}

// Of two lights that shine alike one goes out, and comes back: half of the light, in the mean over the
// pixels.
TEST_F(Gradient, OneLightOfTwo) {
    host.upload(std::vector{light(1, 0.2f, 1), light(2, 0.2f, 1)});
    for (int i = 0; i < 4; ++i) frame();
    host.upload(std::vector{light(1, 0.2f, 1)});
    EXPECT_NEAR(mean(frame()), 0.5, 0.07);
    EXPECT_LT(mean(frame()), kRounding);
    host.upload(std::vector{light(1, 0.2f, 1), light(2, 0.2f, 1)});
    EXPECT_NEAR(mean(frame()), 0.5, 0.07);
    EXPECT_LT(mean(frame()), kRounding);
}

TEST_F(Gradient, SeesABlockerArrive) {
    host.upload(std::vector{light(1, 0, 1)});
    for (int i = 0; i < 2; ++i) frame();
    samples::SceneData data = planeScene();
    addQuad(data, lamp({0, 0.95f, 0}, 0.5f), {.color = {0, 0, 0}, .specular = 0});
    const samples::GpuScene blocked(device(), std::move(data));
    const auto block = [&](restir::FrameInput& input) { input.tlas = blocked.tlas(); };
    expect(frame(block), 1, "blocked");
    expect(frame(block), 0, "in the dark");
    device().waitIdle();
}

}   // namespace
}   // namespace tests
