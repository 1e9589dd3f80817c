// What the debug views say about a scene where it is known: two point lights over the plane, the left quarter
// empty.
#include <gtest/gtest.h>

#include "image/host_view.h"
#include "image/hypothesis.h"
#include "image/stage.h"
#include "image/world.h"

namespace tests {
namespace {

using restir::DebugView;
using restir::Light;

constexpr VkExtent2D kExtent{32, 24};
constexpr size_t kPixels = kExtent.width * kExtent.height;
constexpr uint32_t kMaxHistory = 5;

bool empty(size_t pixel) { return pixel % kExtent.width < 8; }

class Debug : public testing::Test {
protected:
    Debug() : scene(device(), planeScene()), host(scene, planeScene().views[0], {kExtent, 8, {}, 0, true}) {
        settings.di.maxHistory = kMaxHistory;
        settings.di.cutSamples = 1;
        std::vector<glm::vec4> depths(kPixels);
        const samples::CameraPose pose = samples::makePose(planeScene().views[0], kExtent);
        for (size_t i = 0; i < kPixels; ++i) {
            glm::dvec3 point;
            planePoint(pose, kExtent, glm::dvec2(i % kExtent.width, i / kExtent.width) + 0.5, point);
            depths[i].x = empty(i) ? -1 : glm::dot(glm::vec3(point) - pose.eye, pose.forward);
        }
        depth = floatImage(kExtent, depths);
    }
    static Light light(uint32_t id, float x) {
        return {.id = id, .kind = restir::LightKind::Point, .position = {x, 1, 0}, .emission = {1, 1, 1}};
    }
    std::span<const glm::vec4> show(DebugView view, uint32_t index) {
        settings.debugView = view;
        restir::FrameInput input = host.input(index);
        input.gbuffer.depth = {depth.view()};
        input.gbuffer.depthKind = restir::DepthKind::Linear;
        input.gbuffer.emptyDepth = -1;
        const samples::FloatImage image = host.frame(input, settings);
        EXPECT_TRUE(allFinite(image));
        return host.read(input.frameSlot, Target::Debug);
    }
    // `number` is what every pixel with a surface must have in w; the others are 0.
    void expect(std::span<const glm::vec4> shown, const std::function<bool(float)>& number,
                const char* name) {
        ASSERT_EQ(shown.size(), kPixels);
        for (size_t i = 0; i < kPixels; ++i) {
            if (empty(i)) {
                ASSERT_EQ(shown[i], glm::vec4(0)) << name << " " << i;
            } else {
                ASSERT_TRUE(number(shown[i].w)) << name << " " << i << ": " << shown[i].w;
                ASSERT_GT(shown[i].x + shown[i].y + shown[i].z, 0) << name << " " << i;
            }
        }
    }

    samples::GpuScene scene;
    HostView host;
    samples::GpuImage depth;
    restir::Settings settings = unbiased();
};

TEST_F(Debug, ConfidenceGrowsByAFrameUpToTheCap) {
    host.upload(std::vector{light(3, 0.4f)});
    settings.di.spatialPasses = 0;
    for (uint32_t frame = 0; frame < kMaxHistory + 3; ++frame) {
        const float expected = float(std::min(frame, kMaxHistory) + 1);
        expect(
            show(DebugView::Confidence, frame), [&](float m) { return m == expected; }, "confidence");
    }
}

// A sample is either fresh or a frame older than one of the last frame.
TEST_F(Debug, AgeGrowsByAFrame) {
    host.upload(std::vector{light(3, 0.4f)});
    float oldest = 0;
    for (uint32_t frame = 0; frame < 4; ++frame) {
        const auto shown = show(DebugView::Age, frame);
        expect(
            shown, [&](float age) { return age >= 0 && age <= float(frame) && age == std::floor(age); },
            "age");
        for (const glm::vec4& pixel : shown) oldest = std::max(oldest, pixel.w);
    }
    EXPECT_EQ(oldest, 3);
}

TEST_F(Debug, TheLightAndItsColor) {
    host.upload(std::vector{light(3, 0.4f)});
    expect(
        show(DebugView::Light, 0), [](float id) { return id == 3; }, "light");
    const glm::vec4 color = show(DebugView::Light, 1).back();
    host.upload(std::vector{light(5, 0.4f)});
    expect(
        show(DebugView::Light, 2), [](float id) { return id == 5; }, "light");
    EXPECT_NE(glm::vec3(show(DebugView::Light, 3).back()), glm::vec3(color));
}

// Without extent and alone: chosen with probability 1, so that W is 1.
TEST_F(Debug, AllOfASingleLight) {
    host.upload(std::vector{light(3, 0.4f)});
    settings.di.bsdfCandidates = 0;
    expect(
        show(DebugView::Weight, 0), [](float w) { return std::abs(w - 1) < 1e-4f; }, "weight");
    expect(
        show(DebugView::Visibility, 1), [](float v) { return v == 1; }, "visibility");
    const auto samples = show(DebugView::Samples, 2);
    expect(
        samples, [](float distance) { return distance > 0.9f && distance < 10; }, "samples");
    EXPECT_EQ(glm::vec3(samples.back()), glm::vec3(0, 0, 1));
    // Each pixel around shares it: 48 of them inside, 15 in the corner.
    const auto duplicates = show(DebugView::Duplicates, 3);
    EXPECT_EQ(duplicates[12 * kExtent.width + 16].w, 48);
    EXPECT_EQ(duplicates[kPixels - 1].w, 15);
}

TEST_F(Debug, GreyWithoutASample) {
    host.upload({});
    for (DebugView view : {DebugView::Age, DebugView::Weight, DebugView::Light, DebugView::Visibility,
                           DebugView::Samples, DebugView::Duplicates}) {
        const auto shown = show(view, uint32_t(view));
        expect(
            shown, [](float number) { return number == -1; }, "no sample");
        EXPECT_EQ(glm::vec3(shown.back()), glm::vec3(0.5f));
    }
}

TEST_F(Debug, TwoLightsShareThePicture) {
    host.upload(std::vector{light(1, -0.4f), light(2, 0.4f)});
    size_t first = 0, second = 0;
    for (const glm::vec4& pixel : show(DebugView::Light, 0)) {
        first += pixel.w == 1;
        second += pixel.w == 2;
    }
    EXPECT_EQ(first + second, kPixels * 3 / 4);
    EXPECT_GT(first, 50u);
    EXPECT_GT(second, 50u);
}

// The plane alone: near its edge some are empty, far from all edges none is rejected.
TEST_F(Debug, NeighboursRejectedForWhatTheyAre) {
    host.upload(std::vector{light(3, 0.4f)});
    settings.di.radius = 4;
    const auto shown = show(DebugView::Neighbours, 0);
    expect(
        shown, [&](float taken) { return taken >= 0 && taken <= float(settings.di.neighbours); },
        "neighbours");
    const auto at = [&](size_t x, size_t y) { return shown[y * kExtent.width + x]; };
    size_t whole = 0, nearEmpty = 0, nearBorder = 0;
    for (size_t y = 6; y < 18; ++y) {
        for (size_t x = 14; x < 26; ++x) whole += at(x, y).w >= 4;   // the pixel itself may be among them
        nearEmpty += at(8, y).y > at(8, y).x;
        nearBorder += at(31, y).x > 0.3f && at(31, y).w < 5;
        for (size_t x = 8; x < kExtent.width; ++x)
            EXPECT_NEAR(at(x, y).x, at(x, y).z, 0.02f);   // no red, no blue
    }
    EXPECT_EQ(whole, 144u);
    EXPECT_GT(nearEmpty, 6u);
    EXPECT_GT(nearBorder, 6u);
}

}   // namespace
}   // namespace tests
