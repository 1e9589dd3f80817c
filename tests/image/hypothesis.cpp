#include "image/hypothesis.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace tests {

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
