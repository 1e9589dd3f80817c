// A Session as hosts drive it: determinism, frames in flight, history, extents, what it reports.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <thread>

#include "image/host_view.h"
#include "image/hypothesis.h"
#include "image/stage.h"
#include "image/world.h"

namespace tests {
namespace {

constexpr VkExtent2D kExtent{40, 24};

class SessionTest : public testing::Test {
protected:
    SessionTest() {
        samples::SceneData data = planeScene();
        for (uint32_t i = 0; i < 4; ++i) {
            addQuad(data, lamp({0.5f * float(i) - 0.7f, 1.2f, -0.3f}, 0.1f),
                    {.color = {0, 0, 0}, .emission = {float(i), 2, 3}});
        }
        addQuad(data, lamp({0.1f, 0.95f, -0.3f}, 0.3f), {.specular = 0});
        view = data.views[0];
        scene = std::make_unique<samples::GpuScene>(device(), std::move(data));
        host = makeHost();
    }
    std::unique_ptr<HostView> makeHost(const restir::MemoryProvider& memory = {}) const {
        return std::make_unique<HostView>(
            *scene, view, HostDesc{.maxExtent = kExtent, .memory = memory, .pairedNeighbours = restir::kPresetPartners});
    }
    samples::FloatImage frames(uint32_t first, uint32_t count, uint32_t seed = 0) {
        const samples::FloatImage image = host->frames(first, count, settings, seed);
        EXPECT_TRUE(allFinite(image));
        return image;
    }
    samples::FloatImage cut(uint32_t index, uint32_t seed = 0) {
        restir::FrameInput input = host->input(index);
        input.seed = seed;
        input.resetHistory = true;
        return host->frame(input, settings);
    }

    static double mean(const samples::FloatImage& image) {
        return std::accumulate(image.rgb.begin(), image.rgb.end(), 0.0) / double(image.rgb.size());
    }
    // Over independent seeds, the mean of a picture with history of another extent is that without history.
    void expectSameLight(VkExtent2D before) {
        SCOPED_TRACE(std::to_string(before.width) + " x " + std::to_string(before.height));
        constexpr uint32_t seeds = 24;
        double sum = 0, squares = 0, level = 0;
        for (uint32_t seed = 1; seed <= seeds; ++seed) {
            host->resize(before);
            cut(0, seed);
            frames(1, 1, seed);
            host->resize(kExtent);
            const double with = mean(frames(2, 1, seed)), without = mean(cut(3, seed + seeds));
            sum += with - without;
            squares += (with - without) * (with - without);
            level += without / seeds;
        }
        const double difference = sum / seeds;
        const double error = std::sqrt((squares / seeds - difference * difference) / (seeds - 1));
        std::printf("%u x %u before: %+.2f %% (s.e. %.2f)\n", before.width, before.height, 100 * difference / level,
                    100 * error / level);
        EXPECT_LE(std::abs(difference), studentBound(2, seeds) * error);
        EXPECT_LE(error, 0.05 * level);
    }

    samples::View view;
    std::unique_ptr<samples::GpuScene> scene;
    std::unique_ptr<HostView> host;
    restir::Settings settings = unbiased();
};

TEST_F(SessionTest, SameSeedsGiveTheSameBits) {
    cut(0);
    const samples::FloatImage first = frames(1, 4);
    cut(0);
    EXPECT_EQ(frames(1, 4).rgb, first.rgb);
    cut(0, 1);
    EXPECT_NE(frames(1, 4, 1).rgb, first.rgb);
    cut(0);
    EXPECT_NE(frames(2, 4).rgb, first.rgb);   // other frame indices
}

TEST_F(SessionTest, ResetHistoryIsAFreshSession) {
    frames(0, 4);
    const samples::FloatImage withHistory = frames(4, 1), reset = cut(4), after = frames(5, 2);
    EXPECT_NE(reset.rgb, withHistory.rgb);
    host->newSession();
    EXPECT_EQ(frames(4, 1).rgb, reset.rgb);
    EXPECT_EQ(frames(5, 2).rgb, after.rgb);
}

TEST_F(SessionTest, FourFramesInOneCommandBuffer) {
    std::vector<samples::FloatImage> separate;
    for (uint32_t i = 0; i < HostView::kSlots; ++i) separate.push_back(frames(i, 1));
    EXPECT_NE(separate[3].rgb, separate[0].rgb);
    host->newSession();
    device().submitAndWait([&](VkCommandBuffer cmd) {
        for (uint32_t i = 0; i < HostView::kSlots; ++i) host->record(cmd, host->input(i), settings);
    });
    for (uint32_t i = 0; i < HostView::kSlots; ++i) EXPECT_EQ(host->read(i).rgb, separate[i].rgb) << i;
}

TEST_F(SessionTest, ExtentsUpToTheLargest) {
    uint32_t index = 0;
    for (VkExtent2D extent : std::initializer_list<VkExtent2D>{kExtent, {17, 9}, {1, 1}, {1, 24}, {40, 1}, kExtent}) {
        SCOPED_TRACE(std::to_string(extent.width) + " x " + std::to_string(extent.height));
        host->resize(extent);
        for (uint32_t i = 0; i < 3; ++i) {
            const samples::FloatImage image = frames(index++, 1);
            EXPECT_EQ(image.rgb.size(), size_t{3} * extent.width * extent.height);
            EXPECT_GT(largest(image), 0);
        }
    }
    expectSameLight({17, 9});
    expectSameLight({1, 24});
}

// In pairs every kind of reuse goes on, whatever the extent, and the buffers that were declared suffice.
TEST_F(SessionTest, PartnersAtAnyExtent) {
    settings.di.pairedNeighbours = true;
    uint32_t index = 0;
    for (VkExtent2D extent : std::initializer_list<VkExtent2D>{kExtent, {17, 9}, {1, 1}, {1, 24}, kExtent}) {
        SCOPED_TRACE(std::to_string(extent.width) + " x " + std::to_string(extent.height));
        host->resize(extent);
        for (uint32_t neighbours : {1u, 4u, 8u}) {
            settings.di.neighbours = neighbours;
            settings.di.spatialPasses = 1 + neighbours % 3;
            EXPECT_GT(largest(frames(index++, 1)), 0);
        }
    }
    settings.di.neighbours = 5;
    settings.di.spatialPasses = 1;
    expectSameLight({17, 9});
    expectSameLight({1, 24});
}

TEST_F(SessionTest, PartnersShareRays) {
    settings.counters = true;
    settings.di.temporal = false;
    const auto raysOf = [&](uint32_t passes, bool paired) {
        settings.di.spatialPasses = passes;
        settings.di.pairedNeighbours = paired;
        frames(0, 1);
        return double(host->session().counters(0).rays);
    };
    const double none = raysOf(0, false);   // candidates; nothing is left to trace in shading
    EXPECT_NEAR((raysOf(1, true) - none) / (raysOf(1, false) - none), 0.5, 0.1);
}

TEST_F(SessionTest, PlanDoesNotAdvanceHistory) {
    const samples::FloatImage expected = frames(0, 3);
    host->newSession();
    samples::FloatImage image;
    for (uint32_t i = 0; i < 3; ++i) {
        for (int again = 0; again < 3; ++again) ASSERT_TRUE(host->session().plan(host->input(i), settings));
        image = frames(i, 1);
    }
    EXPECT_EQ(image.rgb, expected.rgb);
}

TEST_F(SessionTest, TimingsNameThePlannedPasses) {
    settings.di.spatialPasses = 2;
    frames(0, 1);
    auto planned = host->session().plan(host->input(1), settings);
    ASSERT_TRUE(planned);
    std::vector<std::string> names;
    for (const restir::PassInfo& pass : *planned) names.emplace_back(pass.name);
    EXPECT_EQ(std::count(names.begin(), names.end(), "di.spatial"), 2);
    EXPECT_EQ(std::count(names.begin(), names.end(), "di.temporal"), 1);
    frames(1, 1);
    const auto timings = host->session().timings(1);
    ASSERT_TRUE(device().hasTimestamps());
    ASSERT_EQ(timings.size(), names.size());
    double sum = 0;
    for (size_t i = 0; i < names.size(); ++i) {
        EXPECT_EQ(timings[i].name, names[i]);
        EXPECT_GE(timings[i].milliseconds, 0);
        EXPECT_LT(timings[i].milliseconds, 60'000);
        sum += timings[i].milliseconds;
    }
    EXPECT_GT(sum, 0);
    EXPECT_TRUE(host->session().timings(2).empty());                  // nothing recorded there yet
    EXPECT_TRUE(host->session().timings(HostView::kSlots).empty());   // no such slot
}

TEST_F(SessionTest, LightTablesNameTheirPasses) {
    restir::LightTable& lights = host->lights();
    const auto names = [&](uint32_t slot) {
        std::vector<std::string> result;
        for (const restir::PassTiming& timing : lights.timings(slot)) {
            EXPECT_GE(timing.milliseconds, 0);
            EXPECT_LT(timing.milliseconds, 60'000);
            result.emplace_back(timing.name);
        }
        return result;
    };
    const std::vector<std::string> all{"lights.extent", "lights.power",  "lights.sum",  "lights.scale",
                                       "lights.reduce", "lights.prefix", "lights.scan", "lights.alias",
                                       "lights.sort",   "lights.split",  "lights.nodes"};
    EXPECT_EQ(names(0), all);
    EXPECT_TRUE(names(1).empty());                  // nothing recorded there yet
    EXPECT_TRUE(names(HostView::kSlots).empty());   // no such slot
    const restir::Light sun{.id = 0, .kind = restir::LightKind::Directional};
    host->upload(std::span(&sun, 1));
    EXPECT_EQ(names(0), all);
    host->upload({});
    EXPECT_TRUE(names(0).empty());
}

TEST_F(SessionTest, CountersCountRays) {
    settings.counters = true;
    const uint32_t pixels = kExtent.width * kExtent.height;
    settings.di = {.mode = restir::DirectMode::NextEvent, .lightCandidates = 3};
    frames(0, 1);
    const restir::Counters nextEvent = host->session().counters(0);
    EXPECT_GT(nextEvent.rays, pixels);
    EXPECT_LE(nextEvent.rays, 3 * pixels);
    settings.di = unbiased().di;
    frames(1, 2);
    const restir::Counters restir = host->session().counters(2);
    // One shadow ray and one direction; a ray a neighbour, and one more, in two combinations.
    EXPECT_GT(restir.rays, 2 * pixels);
    EXPECT_LE(restir.rays, (2 + 2 + 1 + settings.di.neighbours) * pixels);
    EXPECT_EQ(restir.rejectedWeights, 0u);
    EXPECT_EQ(host->session().counters(HostView::kSlots).rays, 0u);
}

// A frame without history has the rounds of cutSamples, and its reservoirs their confidence; no other frame
// has.
TEST_F(SessionTest, CutsTakeMoreSamples) {
    settings.counters = true;
    settings.di.cutSamples = 4;
    const samples::FloatImage first = frames(0, 1);
    const uint32_t atCut = host->session().counters(0).rays;
    frames(1, 1);
    EXPECT_LT(host->session().counters(1).rays, atCut);
    cut(2);
    EXPECT_GT(host->session().counters(2).rays, host->session().counters(1).rays);

    host->newSession();
    settings.di.initialSamples = 4;
    settings.di.cutSamples = 1;   // fewer changes nothing
    EXPECT_LE(largestDifference(frames(0, 1), first), 1e-5);
    settings.di.initialSamples = 1;
    host->newSession();
    frames(0, 1);
    EXPECT_LT(host->session().counters(0).rays, atCut);
    settings.di.cutSamples = 4;
    settings.di.temporal = false;   // without temporal reuse every frame is the same
    host->newSession();
    const samples::FloatImage still = frames(0, 1);
    settings.di.cutSamples = 1;
    host->newSession();
    EXPECT_EQ(frames(0, 1).rgb, still.rgb);
}

// A session that declares kPresetPartners and indirect light takes any preset in any frame.
TEST_F(SessionTest, PresetsFollowOneAnother) {
    host = std::make_unique<HostView>(
        *scene, view,
        HostDesc{.maxExtent = kExtent, .pairedNeighbours = restir::kPresetPartners, .indirect = true});
    settings.counters = true;
    uint32_t frame = 0;
    for (auto preset : {restir::Preset::Fast, restir::Preset::Balanced, restir::Preset::Quality,
                        restir::Preset::Unbiased, restir::Preset::Fast}) {
        settings.di = restir::presetSettings(preset);
        settings.gi = restir::presetIndirect(preset);
        for (uint32_t end = frame + 2; frame < end; ++frame) {
            EXPECT_GT(largest(frames(frame, 1)), 0);
            EXPECT_EQ(host->session().counters(frame % HostView::kSlots).rejectedWeights, 0u);
        }
    }
}

// Half of the pixels take half of the rays, and in turns: who is filled in now had a reservoir in the last frame.
TEST_F(SessionTest, CheckerboardTakesTurns) {
    settings.counters = true;
    frames(0, 3);
    const uint32_t whole = host->session().counters(2).rays;
    settings.di.checkerboard = true;
    host->newSession();
    const samples::FloatImage first = frames(0, 2);
    frames(2, 1);
    EXPECT_NEAR(host->session().counters(2).rays, whole / 2, whole / 20);
    host->newSession();
    EXPECT_EQ(frames(0, 2).rgb, first.rgb);
    frames(2, 1);
    settings.di.checkerboard = false;   // one with only half a history
    frames(3, 1);
    EXPECT_NEAR(host->session().counters(3).rays, whole, whole / 10);
}

TEST_F(SessionTest, RayLogHoldsWhatWasTraced) {
    HostView logged(*scene, view, {.maxExtent = kExtent, .rayLogCapacity = 100});
    ASSERT_NE(logged.session().rayLog(), VkBuffer{});
    settings.counters = true;
    logged.frames(0, 2, settings);
    const restir::Counters counters = logged.session().counters(1);
    EXPECT_GT(counters.rays, 100u);
    EXPECT_EQ(counters.loggedRays, 100u);
    EXPECT_EQ(host->session().rayLog(), VkBuffer{});
}

// A single light without extent: nothing is random.
TEST_F(SessionTest, OriginsShiftThePicture) {
    restir::Light light{.id = 0, .kind = restir::LightKind::Point, .position = {0.3f, 2, 0}};
    host->upload(std::span(&light, 1));
    const samples::FloatImage whole = frames(0, 1);
    // The lower right quarter as a view of its own: x' = 2 x - w with w = -z, likewise y.
    const VkExtent2D half{kExtent.width / 2, kExtent.height / 2};
    restir::FrameInput input = host->input(0);
    input.extent = half;
    input.gbuffer.origin = {int32_t(half.width), int32_t(half.height)};
    input.output.origin = input.gbuffer.origin;
    float* projection = input.camera.clipFromView.m;
    projection[0] *= 2;
    projection[5] *= 2;
    projection[8] = projection[9] = 1;
    host->newSession();
    const samples::FloatImage shifted = host->frame(input, settings);
    ASSERT_EQ(shifted.rgb.size(), whole.rgb.size());
    for (uint32_t y = half.height; y < kExtent.height; ++y) {
        for (uint32_t x = 3 * half.width; x < 3 * kExtent.width; ++x) {
            const size_t i = size_t{3} * y * kExtent.width + x;
            ASSERT_NEAR(shifted.rgb[i], whole.rgb[i], 1e-4f * whole.rgb[i]) << i;
        }
    }
}

// A loading thread makes pipelines that the frames beside it need, too, and others.
TEST_F(SessionTest, PipelinesAreMadeBesideFrames) {
    const samples::FloatImage expected = makeHost()->frames(0, 3, settings, 0);
    restir::Settings other = settings;
    other.di.fused = !other.di.fused;
    const restir::FrameInput input = host->input(0);
    restir::Session session = device().require(
        restir::Session::create(host->context(), {.maxExtent = kExtent, .pairedNeighbours = restir::kPresetPartners}), "Session");
    restir::Status first = restir::Status::DeviceError, second = first;
    samples::FloatImage image;
    {
        const std::jthread loading([&] {
            first = session.makePipelines(input, settings);
            second = session.makePipelines(input, other);
        });
        image = frames(0, 3);
    }
    EXPECT_EQ(first, restir::Status::Ok);
    EXPECT_EQ(second, restir::Status::Ok);
    EXPECT_EQ(image.rgb, expected.rgb);
}

}   // namespace
}   // namespace tests
