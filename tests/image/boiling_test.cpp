// The boiling filter: less error for a bias of known sign and size.
#include <gtest/gtest.h>

#include "image/host_view.h"
#include "image/hypothesis.h"
#include "image/stage.h"
#include "image/world.h"

namespace tests {
namespace {

constexpr VkExtent2D kExtent{32, 32};
constexpr uint32_t kLights = 200, kFrames = 12;

// Many bulbs close to the plane, drawn by power alone and seldom: what makes reservoirs boil.
std::vector<restir::Light> bulbs() {
    samples::build::Rng rng(5);
    std::vector<restir::Light> lights;
    for (uint32_t i = 0; i < kLights; ++i) {
        restir::Light light{.id = i, .kind = restir::LightKind::Point};
        light.position[0] = rng.range(-0.6f, 0.6f);
        light.position[1] = rng.range(0.05f, 0.3f);
        light.position[2] = rng.range(-0.9f, 0.5f);
        for (float& e : light.emission) e = rng.range(0.02f, 0.1f);
        lights.push_back(light);
    }
    return lights;
}

samples::FloatImage truth(const samples::View& view, const std::vector<restir::Light>& lights) {
    return planePicture(view, kExtent, 1, [&](glm::dvec3 p) {
        glm::dvec3 sum(0);
        for (const restir::Light& light : lights) {
            const glm::dvec3 d = glm::dvec3(light.position[0], light.position[1], light.position[2]) - p;
            const double distance = glm::length(d);
            sum += glm::dvec3(light.emission[0], light.emission[1], light.emission[2]) * d.y /
                   (distance * distance * distance);
        }
        return sum;
    });
}

class Boiling : public testing::Test {
protected:
    Boiling() {
        samples::SceneData data = planeScene();
        view_ = data.views[0];
        scene_ = std::make_unique<samples::GpuScene>(device(), std::move(data));
        host_ =
            std::make_unique<HostView>(*scene_, view_, HostDesc{.maxExtent = kExtent, .maxLights = kLights});
        host_->upload(lights);
    }
    Agreement against(const samples::FloatImage& truth, float strength, double& error) {
        restir::Settings settings;
        settings.di.lightCandidates = 1;
        settings.di.bsdfCandidates = 0;
        settings.di.cutSamples = 1;
        settings.di.treeShare = 0;   // with the tree nothing boils here
        settings.di.boilingFilter = strength;
        SeedStatistics statistics;
        error = 0;
        for (uint32_t seed = 1; seed <= kPictures; ++seed) {
            restir::FrameInput first = host_->input(0);
            first.seed = seed;
            first.resetHistory = true;
            host_->frame(first, settings);
            const samples::FloatImage image = host_->frames(1, kFrames - 1, settings, seed);
            statistics.add(image);
            for (size_t i = 0; i < image.rgb.size(); ++i) {
                const double difference = double(image.rgb[i]) / double(truth.rgb[i]) - 1;
                error += difference * difference / double(image.rgb.size() * kPictures);
            }
        }
        const Agreement agreement = compare(statistics, exactly(truth));
        print(("strength " + std::to_string(strength)).c_str(), agreement);
        std::printf("    error %.3f\n", error);
        return agreement;
    }

    static constexpr uint32_t kPictures = 96;
    std::vector<restir::Light> lights = bulbs();
    samples::View view_;
    std::unique_ptr<samples::GpuScene> scene_;
    std::unique_ptr<HostView> host_;
};

TEST_F(Boiling, FilterTradesErrorForDarkness) {
    const samples::FloatImage exact = truth(view_, lights);
    double errorOff = 0, error = 0;
    const Agreement off = against(exact, 0, errorOff);
    EXPECT_LE(off.worstZ, studentBound(off.blocks, kPictures));
    const Agreement filtered = against(exact, 0.5f, error);
    EXPECT_LT(error, 0.9 * errorOff);
    for (size_t c = 0; c < 3; ++c) {
        EXPECT_LT(filtered.channelRatio[c], -0.03);
        EXPECT_GT(filtered.channelRatio[c], -0.06);
        EXPECT_LT(filtered.channelRatio[c], -6 * filtered.channelError[c]);
    }
}

}   // namespace
}   // namespace tests
