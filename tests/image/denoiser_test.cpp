// The samples' denoiser: far less error than what goes in, hardly any light lost, and nothing of it persists
// that is not finite.
#include <gtest/gtest.h>

#include <common/builtin.h>
#include <proof/measures.h>

#include "image/world.h"

namespace tests {
namespace {

constexpr VkExtent2D kExtent{64, 48};

double meanLuminance(const samples::FloatImage& image) {
    double sum = 0;
    for (size_t i = 0; i < image.rgb.size() / 3; ++i) sum += luminance(image, i);
    return sum / double(image.rgb.size() / 3);
}

class Denoising : public testing::Test {
protected:
    Denoising() : world(samples::makeBuiltin("cornell"), kExtent) { settings.gi.mode = restir::IndirectMode::Restir; }
    const samples::FloatImage& truth() {
        static const samples::FloatImage image =
            world.reference({.view = world.view(), .frames = 16, .accumulate = true, .jitter = false},
                            {.paths = 32, .bounces = settings.gi.bounces});
        return image;
    }
    // `light`: the least share of it that is kept.
    void expectBetter(samples::Sequence sequence, double times, double light) {
        const samples::FloatImage raw = world.render(sequence, settings);
        sequence.denoise = true;
        const samples::FloatImage quiet = world.render(sequence, settings);
        for (const float value : quiet.rgb) ASSERT_TRUE(std::isfinite(value) && value >= 0);
        const double before = relativeError(raw, truth()), after = relativeError(quiet, truth());
        const double kept = meanLuminance(quiet) / meanLuminance(truth());
        std::printf("error %.4f, denoised %.4f, light %.3f\n", before, after, kept);
        EXPECT_LT(times * after, before);
        EXPECT_GT(kept, light);
        EXPECT_LT(kept, 1.03);
    }
    World world;
    restir::Settings settings = unbiased();
};

// 3.3, 6.0, 14 and 49 times when this was written: what is left of the noise hardly depends on what there was. Pixels brighter than all around them are cut back, which costs plain paths most.
TEST_F(Denoising, StandingStill) { expectBetter({.view = world.view(), .frames = 16}, 3, 0.96); }
TEST_F(Denoising, CameraInMotion) { expectBetter({.view = world.view(), .frames = 16, .orbitDegrees = 1}, 5, 0.96); }
TEST_F(Denoising, OneFrame) { expectBetter({.view = world.view(), .frames = 1}, 10, 0.95); }
TEST_F(Denoising, PlainPaths) {
    settings.di.mode = restir::DirectMode::NextEvent;
    settings.di.lightCandidates = 1;
    settings.gi.mode = restir::IndirectMode::Path;
    expectBetter({.view = world.view(), .frames = 16}, 20, 0.88);
}

}   // namespace
}   // namespace tests
