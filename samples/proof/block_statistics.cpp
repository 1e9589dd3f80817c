#include "proof/block_statistics.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "proof/student.h"

namespace proof {
namespace {

// Two independent errors together (Welch 1947).
double freedomOf(double a, double freedomA, double b, double freedomB) {
    const double sum = a * a + b * b;
    const double spread = std::pow(a, 4) / freedomA + std::pow(b, 4) / freedomB;
    return spread > 0 ? sum * sum / spread : std::numeric_limits<double>::infinity();
}

Estimate ratioOf(const Estimate& value, const Estimate& reference) {
    return {value.mean / reference.mean - 1, std::hypot(value.error, reference.error) / reference.mean,
            freedomOf(value.error, value.freedom, reference.error, reference.freedom)};
}

// Of the mean of z^2 over `blocks`: 2 / n^2 times the sum of all squared correlations. A correlation
// estimated from few pictures has a square that is too large by the inverse of their degrees of freedom.
double spreadOfMeanSquareZ(const SeedStatistics& picture, const ReferenceBlocks& reference,
                           const std::vector<size_t>& blocks) {
    const auto variance = [&](size_t i) { return picture.blockVariance(i) + reference.variance[i]; };
    const double freedom = double(picture.pictures()) - 1;
    double squares = 0;
    for (size_t a = 0; a < blocks.size(); ++a) {
        for (size_t b = 0; b < a; ++b) {
            const double covariance = picture.blockCovariance(blocks[a], blocks[b]);
            const double scale = variance(blocks[a]) * variance(blocks[b]);
            if (scale > 0) squares += 2 * (covariance * covariance / scale - 1 / freedom);
        }
    }
    const double n = double(blocks.size());
    return std::sqrt(2 * (n + std::max(squares, 0.0))) / n;
}

}   // namespace

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
    const size_t n = blocks.mean.size();
    sums_.sum.resize(n);
    sums_.products.resize(n * (n + 1) / 2);
    std::array<double, 3> mean{};
    size_t counted = 0, product = 0;
    for (size_t i = 0; i < n; ++i) {
        const double value = luminance(blocks.mean[i]);
        sums_.sum[i] += value;
        for (size_t j = 0; j <= i; ++j) sums_.products[product++] += value * luminance(blocks.mean[j]);
        if (!counts(i)) continue;
        ++counted;
        for (size_t c = 0; c < 3; ++c) mean[c] += blocks.mean[i][c];
    }
    for (double& m : mean) m /= double(counted);
    sums_.channels.push_back(mean);
    ++sums_.pictures;
}

double SeedStatistics::blockCovariance(size_t a, size_t b) const {
    const double n = double(pictures());
    const size_t i = std::max(a, b), j = std::min(a, b);
    const double covariance = sums_.products[i * (i + 1) / 2 + j] / n - blockMean(a) * blockMean(b);
    return (a == b ? std::max(0.0, covariance) : covariance) / (n - 1);
}

std::array<double, 3> SeedStatistics::channelMean() const {
    std::array<double, 3> mean{};
    for (const auto& picture : sums_.channels)
        for (size_t c = 0; c < 3; ++c) mean[c] += picture[c] / double(pictures());
    return mean;
}

std::array<double, 3> SeedStatistics::channelError() const {
    const double n = double(pictures());
    const std::array<double, 3> mean = channelMean();
    std::array<double, 3> error{};
    for (const auto& picture : sums_.channels)
        for (size_t c = 0; c < 3; ++c) error[c] += (picture[c] - mean[c]) * (picture[c] - mean[c]);
    for (double& e : error) e = std::sqrt(e / (n * (n - 1)));
    return error;
}

Estimate SeedStatistics::luminanceMean() const {
    const double n = double(pictures()), mean = luminance(channelMean());
    double squares = 0;
    for (const auto& picture : sums_.channels) squares += std::pow(luminance(picture) - mean, 2);
    return {mean, std::sqrt(squares / (n * (n - 1))), n - 1};
}

double SeedStatistics::luminanceSkewness() const {
    const double n = double(pictures()), mean = luminance(channelMean());
    double squares = 0, cubes = 0;
    for (const auto& picture : sums_.channels) {
        const double d = luminance(picture) - mean;
        squares += d * d / n;
        cubes += d * d * d / n;
    }
    return squares > 0 ? cubes / std::pow(squares, 1.5) : 0;
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
    double variance = 0;
    for (size_t i = 0; i < means.mean.size(); ++i) {
        reference.mean.push_back(luminance(means.mean[i]));
        reference.variance.push_back(variances.mean[i][0]);
        if (!mask.counts(i)) continue;
        ++counted;
        for (size_t c = 0; c < 3; ++c) reference.channelMean[c] += means.mean[i][c];
        variance += variances.mean[i][0];
    }
    for (double& mean_ : reference.channelMean) mean_ /= double(counted);
    const double error = std::sqrt(variance) / double(counted);
    reference.channelError = {error, error, error};
    reference.luminanceMean = {luminance(reference.channelMean), error, double(counted * kBlock * kBlock)};
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
    reference.luminanceMean = seeds.luminanceMean();
    return reference;
}

ReferenceBlocks exactly(const samples::FloatImage& image) {
    ReferenceBlocks reference;
    const Blocks blocks = blocksOf(image);
    for (const auto& mean : blocks.mean) {
        reference.mean.push_back(luminance(mean));
        reference.variance.push_back(0);
        for (size_t c = 0; c < 3; ++c) reference.channelMean[c] += mean[c] / double(blocks.mean.size());
    }
    reference.luminanceMean = {luminance(reference.channelMean), 0, 1};
    return reference;
}

Agreement compare(const SeedStatistics& picture, const ReferenceBlocks& reference) {
    Agreement result;
    const auto mean = picture.channelMean(), error = picture.channelError();
    for (size_t c = 0; c < 3; ++c) {
        result.channelRatio[c] = mean[c] / reference.channelMean[c] - 1;
        result.channelError[c] = std::hypot(error[c], reference.channelError[c]) / reference.channelMean[c];
        result.ownError[c] = error[c] / reference.channelMean[c];
    }
    result.luminanceRatio = ratioOf(picture.luminanceMean(), reference.luminanceMean);
    const Estimate& ratio = result.luminanceRatio;
    result.halfWidth = ratio.error > 0 ? studentQuantile(0.05, ratio.freedom) * ratio.error : 0;
    std::vector<double> sigmas;
    std::vector<size_t> compared;
    size_t inside = 0;
    for (size_t i = 0; i < picture.blocks(); ++i) {
        if (!picture.counts(i) || reference.mean[i] <= 0) continue;
        const double difference = picture.blockMean(i) - reference.mean[i];
        const double sigma = std::sqrt(picture.blockVariance(i) + reference.variance[i]);
        compared.push_back(i);
        sigmas.push_back(sigma / reference.mean[i]);
        if (std::abs(difference) <= 3 * sigma + 0.005 * reference.mean[i]) ++inside;
        const double z = sigma > 0 ? difference / sigma : 0;
        result.meanSquareZ += z * z;
        result.worstZ = std::max(result.worstZ, std::abs(z));
    }
    result.blocks = sigmas.size();
    result.fractionInside = double(inside) / double(sigmas.size());
    result.meanSquareZ /= double(sigmas.size());
    result.meanSquareZSpread = spreadOfMeanSquareZ(picture, reference, compared);
    result.skewness = picture.luminanceSkewness();
    std::nth_element(sigmas.begin(), sigmas.begin() + long(sigmas.size() / 2), sigmas.end());
    result.medianSigma = sigmas[sigmas.size() / 2];
    return result;
}

void print(const char* what, const Agreement& a) {
    std::printf(
        "%-40s  RGB %+.3f %+.3f %+.3f %% (s.e. %.3f %.3f %.3f, own %.3f %.3f %.3f)  %zu blocks: %.1f %% inside, median sigma "
        "%.2f %%, "
        "mean z^2 %.2f +- %.2f, worst |z| %.1f\n",
        what, 100 * a.channelRatio[0], 100 * a.channelRatio[1], 100 * a.channelRatio[2],
        100 * a.channelError[0], 100 * a.channelError[1], 100 * a.channelError[2], 100 * a.ownError[0],
        100 * a.ownError[1], 100 * a.ownError[2], a.blocks,
        100 * a.fractionInside, 100 * a.medianSigma, a.meanSquareZ, a.meanSquareZSpread, a.worstZ);
    std::fflush(stdout);
}

}   // namespace proof
