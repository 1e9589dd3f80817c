#include "support/block_statistics.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace tests {

double luminance(const std::array<double, 3>& c) { return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2]; }

Blocks blocksOf(const samples::FloatImage& image) {
    Blocks blocks{image.width / kBlock, image.height / kBlock, {}};
    blocks.mean.resize(size_t(blocks.columns) * blocks.rows);
    for (uint32_t y = 0; y < blocks.rows * kBlock; ++y)
        for (uint32_t x = 0; x < blocks.columns * kBlock; ++x)
            for (size_t c = 0; c < 3; ++c)
                blocks.mean[size_t(y / kBlock) * blocks.columns + x / kBlock][c] +=
                    double(image.rgb[(size_t(y) * image.width + x) * 3 + c]) / (kBlock * kBlock);
    return blocks;
}

void SeedStatistics::add(const samples::FloatImage& image) {
    const Blocks blocks = blocksOf(image);
    sum_.resize(blocks.mean.size());
    squares_.resize(blocks.mean.size());
    std::array<double, 3> mean{};
    size_t counted = 0;
    for (size_t i = 0; i < blocks.mean.size(); ++i) {
        const double value = luminance(blocks.mean[i]);
        sum_[i] += value;
        squares_[i] += value * value;
        if (!counts(i)) continue;
        ++counted;
        for (size_t c = 0; c < 3; ++c) mean[c] += blocks.mean[i][c];
    }
    for (double& m : mean) m /= double(counted);
    channels_.push_back(mean);
    ++count_;
}

double SeedStatistics::blockVariance(size_t block) const {
    const double n = double(count_), mean = sum_[block] / n;
    return std::max(0.0, squares_[block] / n - mean * mean) / (n - 1);
}

std::array<double, 3> SeedStatistics::channelMean() const {
    std::array<double, 3> mean{};
    for (const auto& picture : channels_)
        for (size_t c = 0; c < 3; ++c) mean[c] += picture[c] / double(count_);
    return mean;
}

std::array<double, 3> SeedStatistics::channelError() const {
    const std::array<double, 3> mean = channelMean();
    std::array<double, 3> error{};
    for (const auto& picture : channels_)
        for (size_t c = 0; c < 3; ++c) error[c] += (picture[c] - mean[c]) * (picture[c] - mean[c]);
    for (double& e : error) e = std::sqrt(e / (double(count_) * double(count_ - 1)));
    return error;
}

ReferenceBlocks referenceFromPair(const samples::FloatImage& a, const samples::FloatImage& b,
                                  const SeedStatistics& mask) {
    samples::FloatImage mean = a, squared = a;
    for (size_t i = 0; i < a.rgb.size(); ++i) {
        mean.rgb[i] = 0.5f * (a.rgb[i] + b.rgb[i]);
        squared.rgb[i] = 0;
    }
    for (size_t p = 0; p < a.rgb.size(); p += 3) {
        std::array<double, 3> difference{};
        for (size_t c = 0; c < 3; ++c) difference[c] = double(a.rgb[p + c]) - double(b.rgb[p + c]);
        const double d = luminance(difference);
        // The mean of the two has a quarter of the variance of their difference.
        squared.rgb[p] = squared.rgb[p + 1] = squared.rgb[p + 2] = float(0.25 * d * d / (kBlock * kBlock));
    }
    const Blocks means = blocksOf(mean), variances = blocksOf(squared);
    ReferenceBlocks reference;
    size_t counted = 0;
    std::array<double, 3> variance{};
    for (size_t i = 0; i < means.mean.size(); ++i) {
        reference.mean.push_back(luminance(means.mean[i]));
        reference.variance.push_back(variances.mean[i][0]);
        if (!mask.counts(i)) continue;
        ++counted;
        for (size_t c = 0; c < 3; ++c) {
            reference.channelMean[c] += means.mean[i][c];
            variance[c] += variances.mean[i][c];
        }
    }
    for (size_t c = 0; c < 3; ++c) {
        reference.channelMean[c] /= double(counted);
        reference.channelError[c] = std::sqrt(variance[c]) / double(counted);
    }
    return reference;
}

ReferenceBlocks referenceFromSeeds(const SeedStatistics& seeds) {
    ReferenceBlocks reference;
    for (size_t i = 0; i < seeds.blocks(); ++i) {
        reference.mean.push_back(seeds.blockMean(i));
        reference.variance.push_back(seeds.blockVariance(i));
    }
    reference.channelMean = seeds.channelMean();
    reference.channelError = seeds.channelError();
    return reference;
}

Agreement compare(const SeedStatistics& picture, const ReferenceBlocks& reference) {
    Agreement result;
    const auto mean = picture.channelMean(), error = picture.channelError();
    for (size_t c = 0; c < 3; ++c) {
        result.channelRatio[c] = mean[c] / reference.channelMean[c] - 1;
        result.channelError[c] = std::hypot(error[c], reference.channelError[c]) / reference.channelMean[c];
    }
    std::vector<double> sigmas;
    size_t inside = 0;
    for (size_t i = 0; i < picture.blocks(); ++i) {
        if (!picture.counts(i) || reference.mean[i] <= 0) continue;
        const double difference = picture.blockMean(i) - reference.mean[i];
        const double sigma = std::sqrt(picture.blockVariance(i) + reference.variance[i]);
        sigmas.push_back(sigma / reference.mean[i]);
        if (std::abs(difference) <= 3 * sigma + 0.005 * reference.mean[i]) ++inside;
        const double z = sigma > 0 ? difference / sigma : 0;
        result.meanSquareZ += z * z;
        result.worstZ = std::max(result.worstZ, std::abs(z));
    }
    result.blocks = sigmas.size();
    result.fractionInside = double(inside) / double(sigmas.size());
    result.meanSquareZ /= double(sigmas.size());
    std::nth_element(sigmas.begin(), sigmas.begin() + long(sigmas.size() / 2), sigmas.end());
    result.medianSigma = sigmas[sigmas.size() / 2];
    return result;
}

void print(const char* what, const Agreement& a) {
    std::printf("%-40s  RGB %+.3f %+.3f %+.3f %% (s.e. %.3f %.3f %.3f)  %zu blocks: %.1f %% inside, median sigma %.2f %%, "
                "mean z^2 %.2f, worst |z| %.1f\n",
                what, 100 * a.channelRatio[0], 100 * a.channelRatio[1], 100 * a.channelRatio[2], 100 * a.channelError[0],
                100 * a.channelError[1], 100 * a.channelError[2], a.blocks, 100 * a.fractionInside, 100 * a.medianSigma,
                a.meanSquareZ, a.worstZ);
    std::fflush(stdout);
}

}   // namespace tests
