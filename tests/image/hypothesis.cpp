#include "image/hypothesis.h"

#include <algorithm>
#include <cmath>
#include <utility>

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
// a standard deviation of 1.6 of its mean keeps within three standard errors of the mean, which for less than
// 200 blocks is more than the bounds for larger sets.
void Verdict::expectUnitVariance() const {
    const double freedom = double(pictures_ - 1);
    const double relative = squares_ / double(blocks_) / (freedom / (freedom - 2));
    std::printf("%zu blocks: mean t^2 %.3f of what Student's distribution has\n", blocks_, relative);
    const double spread = blocks_ < 200 ? 3 * 1.6 / std::sqrt(double(blocks_) / 4) : 0;
    EXPECT_GE(relative, std::min(0.6, 1 - spread));
    EXPECT_LE(relative, std::max(1.5, 1 + spread));
}

namespace {

restir::Settings nearAndShort() {
    restir::Settings settings;
    settings.di.radius = 6;   // keeps blocks apart, and the cap frames: more independent samples in a picture
    settings.di.maxHistory = 5;
    return settings;
}

}   // namespace

std::vector<NamedSettings> unbiasedSettings() {
    using restir::VisibilityReuse;
    using restir::Weights;
    const restir::Settings base = nearAndShort();
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
    restir::Settings rounds = base;
    rounds.di.lightCandidates = 4;
    rounds.di.initialSamples = 3;
    rounds.di.cutSamples = 8;
    all.push_back({"pairwise traced 3 rounds, cut 8", rounds});
    restir::Settings paired = base;
    paired.di.pairedNeighbours = true;
    all.push_back({"paired traced", paired});
    paired.di.weights = Weights::PairwisePlain;
    all.push_back({"paired plain traced", paired});
    paired.di.weights = Weights::Pairwise;
    paired.di.spatialPasses = 2;
    paired.di.neighbours = 4;
    paired.di.bsdfCandidates = 0;
    paired.di.averageShading = false;
    all.push_back({"paired traced, two passes, one shaded", paired});
    paired.di.visibility = VisibilityReuse::None;
    all.push_back({"paired none, two passes", paired});
    restir::Settings permuted = base;
    permuted.di.permuteHistory = true;
    all.push_back({"pairwise traced permuted", permuted});
    restir::Settings ris = base;
    ris.di.temporal = false;
    ris.di.spatialPasses = 0;
    all.push_back({"ris", ris});
    for (auto [name, weights] : {std::pair("basic", Weights::Basic), std::pair("balance", Weights::Balance),
                                 std::pair("pairwise", Weights::Pairwise), std::pair("plain", Weights::PairwisePlain)}) {
        for (auto [seen, visibility] :
             {std::pair("none", VisibilityReuse::None), std::pair("traced", VisibilityReuse::Traced)}) {
            restir::Settings s = base;
            s.di.weights = weights;
            s.di.visibility = visibility;
            s.di.fused = true;
            all.push_back({std::string("fused ") + name + " " + seen, s});
            s.di.fused = false;
            if (weights == Weights::PairwisePlain) all.push_back({std::string(name) + " " + seen, s});
        }
    }
    restir::Settings nee = base;
    nee.di.mode = restir::DirectMode::NextEvent;
    all.push_back({"nee", nee});
    return all;
}

std::vector<NamedSettings> settingsInTheOpen() {
    std::vector<NamedSettings> all = unbiasedSettings();
    std::erase_if(all, [](const NamedSettings& s) {
        return s.settings.di.visibility == restir::VisibilityReuse::None ||
               (s.settings.di.fused && s.settings.di.weights != restir::Weights::Pairwise);
    });
    return all;
}

std::vector<NamedSettings> pairwiseInTheOpen() {
    std::vector<NamedSettings> all = settingsInTheOpen();
    std::erase_if(all, [](const NamedSettings& s) {
        return s.settings.di.weights != restir::Weights::Pairwise && s.settings.di.bsdfCandidates == 0;
    });
    return all;
}

std::vector<NamedSettings> checkerboards() {
    std::vector<NamedSettings> all;
    restir::Settings half = nearAndShort();
    half.di.checkerboard = true;
    all.push_back({"checkerboard traced", half});
    half.di.pairedNeighbours = true;
    all.push_back({"checkerboard paired traced", half});
    half.di.pairedNeighbours = false;
    half.di.visibility = restir::VisibilityReuse::None;
    half.di.fused = true;
    all.push_back({"checkerboard fused none", half});
    return all;
}

namespace {

using Offsets = std::vector<std::pair<int, int>>;

// The mean of a pixel's means over each of `turns`, of those in the picture.
samples::FloatImage meanOfTurns(const samples::FloatImage& image, const std::vector<Offsets>& turns) {
    samples::FloatImage blurred{image.width, image.height, {}};
    const int width = int(image.width), height = int(image.height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < 3; ++c) {
                float mean = 0;
                for (const Offsets& turn : turns) {
                    float sum = 0, count = 0;
                    for (auto [i, j] : turn) {
                        if (x + i < 0 || y + j < 0 || x + i >= width || y + j >= height) continue;
                        sum += image.rgb[size_t(3 * ((y + j) * width + x + i) + c)];
                        ++count;
                    }
                    mean += sum / count / float(turns.size());
                }
                blurred.rgb.push_back(mean);
            }
    return blurred;
}

}   // namespace

samples::FloatImage halfBlurred(const samples::FloatImage& image) {
    return meanOfTurns(image, {{{0, 0}}, {{-1, 0}, {1, 0}, {0, -1}, {0, 1}}});
}

samples::FloatImage blockBlurred(const samples::FloatImage& image) {
    return meanOfTurns(image, {{{0, 0}}, {{-1, 0}, {1, 0}}, {{0, -1}, {0, 1}}, {{-1, -1}, {1, -1}, {-1, 1}, {1, 1}}});
}

bool allFinite(const samples::FloatImage& image) {
    return std::all_of(image.rgb.begin(), image.rgb.end(), [](float v) { return std::isfinite(v); });
}

float largest(const samples::FloatImage& image) { return *std::max_element(image.rgb.begin(), image.rgb.end()); }

size_t otherPixels(const samples::FloatImage& a, const samples::FloatImage& b) {
    size_t other = 0;
    for (size_t i = 0; i < a.rgb.size(); i += 3)
        other += std::abs(a.rgb[i] - b.rgb[i]) > 1e-3f * (a.rgb[i] + b.rgb[i]) ? 1 : 0;
    return other;
}

double largestDifference(const samples::FloatImage& a, const samples::FloatImage& b) {
    double difference = 0;
    for (size_t i = 0; i < a.rgb.size(); ++i)
        difference = std::max(difference, std::abs(double(a.rgb[i]) - double(b.rgb[i])));
    return difference / double(largest(b));
}

}   // namespace tests
