// Against pictures of two independent renderers, where ../shared/scenes is present: per-channel mean within 0.3 %,
// 95 % of the 8x8 blocks within three sigma + 0.5 %.
#include <gtest/gtest.h>

#include "image/world.h"

namespace tests {
namespace {

struct CheckSetup {
    std::string scene, referenceA, referenceB;
    VkExtent2D extent;
    double medianSigma;   // the check must have the power to see what it claims of blocks; 0: it is the mean alone
};

const CheckSetup kCornell{"cornell100/cornell100.gltf", "cornell100/ref/cycles43_direct.exr",
                          "cornell100/ref/pbrt_direct.exr", {256, 256}, 0.01};
const CheckSetup kKitchen{"kitchen/kitchen_night.gltf", "kitchen/ref/night_direct_320x180_a.exr",
                          "kitchen/ref/night_direct_320x180_b.exr", {320, 180}, 0.02};

// The mean of many scatterings less that of direct light is what ReSTIR GI adds; both are checked at once.
const CheckSetup kCornellIndirect{"cornell100/cornell100.gltf", "cornell100/ref/cycles43_4scatter.exr",
                                  "cornell100/ref/pbrt_4scatter.exr", {256, 256}, 0.01};
const CheckSetup kKitchenIndirect{"kitchen/kitchen_night.gltf", "kitchen/ref/night_4scatter_320x180_a.exr",
                                  "kitchen/ref/night_4scatter_320x180_b.exr", {320, 180}, 0};

class Check {
public:
    explicit Check(const CheckSetup& setup) : setup_(setup) {
        std::vector<std::string> warnings;
        samples::SceneData scene = samples::loadScene(sharedScene(setup.scene), warnings);
        samples::makeLambert(scene);
        const samples::View view = scene.views.empty() ? samples::frameScene(scene) : scene.views[0];
        leftOut_ = emitterBlocks(scene, setup.extent, view);
        world_ = std::make_unique<World>(std::move(scene), setup.extent);
        a_ = samples::readExr(sharedScene(setup.referenceA));
        b_ = samples::readExr(sharedScene(setup.referenceB));
    }

    Agreement against(const char* what, const SeedStatistics& statistics) const {
        const Agreement agreement = compare(statistics, referenceFromPair(a_, b_, statistics));
        print(what, agreement);
        return agreement;
    }
    Agreement di(const char* what, uint32_t count, uint32_t frames, const restir::Settings& settings) {
        return against(what, world_->seeds(count, sequence(frames), settings, leftOut_));
    }
    Agreement reference(uint32_t count, uint32_t frames, uint32_t paths, uint32_t bounces = 1) {
        return against("reference",
                       world_->referenceSeeds(count, sequence(frames), {.paths = paths, .bounces = bounces}, leftOut_));
    }
    void expectAgreement(const Agreement& a) const {
        for (size_t c = 0; c < 3; ++c) {
            EXPECT_LE(std::abs(a.channelRatio[c]), 0.003) << "channel " << c;
            EXPECT_LE(a.ownError[c], 0.001) << "channel " << c;   // the references' own noise no frame of ours lessens
        }
        EXPECT_GE(a.fractionInside, 0.95);
        if (setup_.medianSigma > 0) { EXPECT_LE(a.medianSigma, setup_.medianSigma); }
    }

private:
    samples::Sequence sequence(uint32_t frames) const {
        return {.view = world_->view(), .frames = frames, .accumulate = true};
    }

    CheckSetup setup_;
    std::vector<bool> leftOut_;
    std::unique_ptr<World> world_;
    samples::FloatImage a_, b_;
};

restir::Settings offCached() {
    restir::Settings settings;
    settings.di.weights = restir::Weights::Off;
    settings.di.visibility = restir::VisibilityReuse::Cached;
    return settings;
}

restir::Settings withPaths(restir::Settings settings) {
    settings.gi.mode = restir::IndirectMode::Restir;
    settings.gi.bounces = 4;
    settings.gi.maxHistory = 4;
    return settings;
}

// Short histories: what frames of one sequence share falls off sooner, and with it the standard error of their mean.
restir::Settings shortHistory() {
    restir::Settings settings = unbiased();
    settings.di.maxHistory = 4;
    return settings;
}

class LongNumericCheck : public testing::Test {
protected:
    void SetUp() override {
        if (sharedScene(kCornell.scene).empty()) GTEST_SKIP() << "no ../shared/scenes";
    }
};

// Minutes each on two cores of a software driver.
TEST_F(LongNumericCheck, CornellReference) {
    Check check(kCornell);
    check.expectAgreement(check.reference(8, 32, 16));
}

TEST_F(LongNumericCheck, CornellDi) {
    Check check(kCornell);
    check.expectAgreement(check.di("di pairwise traced", 8, 160, shortHistory()));
}

TEST_F(LongNumericCheck, CornellOffCachedFails) {
    Check check(kCornell);
    const Agreement off = check.di("di off cached (must fail)", 8, 12, offCached());
    for (size_t c = 0; c < 3; ++c) EXPECT_GE(-off.channelRatio[c], 0.003 + 5 * off.channelError[c]) << "channel " << c;
}

// An hour or more each.
TEST_F(LongNumericCheck, KitchenReference) {
    Check check(kKitchen);
    check.expectAgreement(check.reference(8, 160, 8));
}

TEST_F(LongNumericCheck, KitchenDi) {
    Check check(kKitchen);
    restir::Settings settings;
    settings.di = restir::presetSettings(restir::Preset::Unbiased);
    settings.di.maxHistory = 4;
    check.expectAgreement(check.di("di pairwise traced", 8, 192, settings));
}

TEST_F(LongNumericCheck, CornellGi) {
    Check check(kCornellIndirect);
    check.expectAgreement(check.di("di + gi pairwise traced", 8, 160, withPaths(shortHistory())));
}

TEST_F(LongNumericCheck, CornellGiReference) {
    Check check(kCornellIndirect);
    check.expectAgreement(check.reference(8, 32, 16, 4));
}

TEST_F(LongNumericCheck, KitchenGiReference) {
    Check check(kKitchenIndirect);
    check.expectAgreement(check.reference(8, 160, 8, 4));
}

// Few pixels bring hundreds of times their light: blocks are as noisy as 6 % here.
TEST_F(LongNumericCheck, KitchenGi) {
    Check check(kKitchenIndirect);
    check.expectAgreement(check.di("di + gi pairwise traced", 24, 192, withPaths(shortHistory())));
}

}   // namespace
}   // namespace tests
