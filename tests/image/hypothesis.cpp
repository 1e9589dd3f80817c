#include "image/hypothesis.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace tests {
namespace {

// With t = sqrt(freedom) tan(angle) the density is cos(angle)^(freedom - 1) up to a constant.
double tailIntegral(double angle, size_t freedom) {
    constexpr int kSteps = 2000;   // Simpson
    const double h = (0.5 * std::numbers::pi - angle) / kSteps;
    double sum = 0;
    for (int i = 0; i <= kSteps; ++i) {
        const double weight = i == 0 || i == kSteps ? 1 : i % 2 == 1 ? 4 : 2;
        sum += weight * std::pow(std::max(std::cos(angle + i * h), 0.0), double(freedom) - 1);
    }
    return sum * h / 3;
}

}   // namespace

double studentQuantile(double alpha, size_t freedom) {
    const double whole = tailIntegral(0, freedom);
    double low = 0, high = 0.5 * std::numbers::pi;
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (tailIntegral(middle, freedom) > alpha * whole ? low : high) = middle;
    }
    return std::sqrt(double(freedom)) * std::tan(low);
}

ReferenceBlocks exactly(const samples::FloatImage& image) {
    ReferenceBlocks reference;
    const Blocks blocks = blocksOf(image);
    for (const auto& mean : blocks.mean) {
        reference.mean.push_back(luminance(mean));
        reference.variance.push_back(0);
        for (size_t c = 0; c < 3; ++c) reference.channelMean[c] += mean[c] / double(blocks.mean.size());
    }
    return reference;
}

void Verdict::add(const std::string& name, const Agreement& a) {
    SCOPED_TRACE(name);
    print(name.c_str(), a);
    EXPECT_LE(a.worstZ, studentBound(estimators_ * a.blocks, pictures_));
    for (size_t c = 0; c < 3; ++c) {
        EXPECT_LE(std::abs(a.channelRatio[c]), studentBound(3 * estimators_, pictures_) * a.channelError[c]);
        EXPECT_LE(a.channelError[c], 0.003);   // a bias of 1 % would be seen
    }
    squares_ += a.meanSquareZ * double(a.blocks);
    blocks_ += a.blocks;
}

// Blocks of one picture are correlated by spatial reuse: as if a quarter of them were independent, t^2 with
// a standard deviation of 1.6 of its mean keeps within three standard errors of the mean. That is 0.2 to 0.35
// for 200 to 500 blocks; the bounds are for the smaller sets.
void Verdict::expectUnitVariance() const {
    const double freedom = double(pictures_ - 1);
    const double relative = squares_ / double(blocks_) / (freedom / (freedom - 2));
    std::printf("%zu blocks: mean t^2 %.3f of what Student's distribution has\n", blocks_, relative);
    EXPECT_GE(relative, 0.6);
    EXPECT_LE(relative, 1.5);
}

std::vector<NamedSettings> unbiasedSettings() {
    using restir::VisibilityReuse;
    using restir::Weights;
    restir::Settings base;
    base.di.radius = 6;   // keeps blocks apart, and the cap frames: more independent samples in a picture
    base.di.maxHistory = 5;
    std::vector<NamedSettings> all;
    for (auto [name, weights] : {std::pair("basic", Weights::Basic), std::pair("balance", Weights::Balance),
                                 std::pair("pairwise", Weights::Pairwise)}) {
        for (auto [seen, visibility] :
             {std::pair("none", VisibilityReuse::None), std::pair("traced", VisibilityReuse::Traced)}) {
            for (uint32_t bsdf : {0u, 1u}) {
                restir::Settings s = base;
                s.di.weights = weights;
                s.di.visibility = visibility;
                s.di.bsdfCandidates = bsdf;
                all.push_back({std::string(name) + " " + seen + " bsdf " + std::to_string(bsdf), s});
            }
        }
    }
    restir::Settings paired = base;
    paired.di.pairedNeighbours = true;
    all.push_back({"paired traced", paired});
    paired.di.spatialPasses = 2;
    paired.di.neighbours = 4;
    paired.di.bsdfCandidates = 0;
    paired.di.averageShading = false;
    all.push_back({"paired traced, two passes, one shaded", paired});
    paired.di.visibility = VisibilityReuse::None;
    all.push_back({"paired none, two passes", paired});
    restir::Settings ris = base;
    ris.di.temporal = false;
    ris.di.spatialPasses = 0;
    all.push_back({"ris", ris});
    restir::Settings nee = base;
    nee.di.mode = restir::DirectMode::NextEvent;
    all.push_back({"nee", nee});
    return all;
}

bool allFinite(const samples::FloatImage& image) {
    return std::all_of(image.rgb.begin(), image.rgb.end(), [](float v) { return std::isfinite(v); });
}

float largest(const samples::FloatImage& image) { return *std::max_element(image.rgb.begin(), image.rgb.end()); }

double largestDifference(const samples::FloatImage& a, const samples::FloatImage& b) {
    double difference = 0;
    for (size_t i = 0; i < a.rgb.size(); ++i)
        difference = std::max(difference, std::abs(double(a.rgb[i]) - double(b.rgb[i])));
    return difference / double(largest(b));
}

}   // namespace tests
