// Statistics over 8x8 blocks of pictures. The sampling unit is a picture from an independent sequence: frames
// of one sequence are correlated (THEORY section 9).
#pragma once

#include <array>
#include <vector>

#include <common/image_io.h>

namespace proof {

inline constexpr uint32_t kBlock = 8;

// Block means of one picture; partial blocks at the right and bottom edges are left out.
struct Blocks {
    uint32_t columns = 0, rows = 0;
    std::vector<std::array<double, 3>> mean;
};
Blocks blocksOf(const samples::FloatImage& image);

double luminance(const std::array<double, 3>& rgb);

// A mean over pictures.
struct Estimate {
    double mean = 0, error = 0;   // standard error of the mean
    double freedom = 0;           // degrees, of the error
};

// What block statistics are made of: enough to go on later.
struct BlockSums {
    size_t pictures = 0;
    std::vector<double> sum;                       // of each block's luminance
    std::vector<double> products;                  // of the luminances of blocks i >= j, at i (i + 1) / 2 + j
    std::vector<std::array<double, 3>> channels;   // of each picture, the mean
};

// Mean and covariance of the mean over pictures, per block and for the whole.
class SeedStatistics {
public:
    // Blocks with `leftOut` set do not count; empty: all count.
    SeedStatistics() = default;
    explicit SeedStatistics(std::vector<bool> leftOut) : leftOut_(std::move(leftOut)) {}
    explicit SeedStatistics(BlockSums sums) : sums_(std::move(sums)) {}

    void add(const samples::FloatImage& image);

    const BlockSums& sums() const { return sums_; }
    size_t pictures() const { return sums_.pictures; }
    size_t blocks() const { return sums_.sum.size(); }
    bool counts(size_t block) const { return leftOut_.empty() || !leftOut_[block]; }
    double blockMean(size_t block) const { return sums_.sum[block] / double(pictures()); }   // luminance
    double blockVariance(size_t block) const { return blockCovariance(block, block); }       // of that mean
    double blockCovariance(size_t a, size_t b) const;   // of the means of two blocks
    std::array<double, 3> channelMean() const;
    std::array<double, 3> channelError() const;   // standard error of it
    Estimate luminanceMean() const;
    double luminanceSkewness() const;   // of pictures, not of their mean

private:
    std::vector<bool> leftOut_;
    BlockSums sums_;
};

// What a picture is held against: block luminances with the variance of each.
struct ReferenceBlocks {
    std::vector<double> mean, variance;
    std::array<double, 3> channelMean{};
    std::array<double, 3> channelError{};
    Estimate luminanceMean;
};
// From two independent converged pictures. Pixels of one block share no noise, so the pixel differences give
// the variance of each block's mean.
ReferenceBlocks referenceFromPair(const samples::FloatImage& a, const samples::FloatImage& b,
                                  const SeedStatistics& mask);
ReferenceBlocks referenceFromSeeds(const SeedStatistics& seeds);
// A picture that is known exactly.
ReferenceBlocks exactly(const samples::FloatImage& image);

struct Agreement {
    std::array<double, 3> channelRatio{};   // picture / reference - 1
    std::array<double, 3> channelError{};   // standard error of it, both sides
    std::array<double, 3> ownError{};       // the picture's share in that
    Estimate luminanceRatio;                // likewise
    double halfWidth = 0;                   // of the 95 % confidence interval of luminanceRatio
    double fractionInside = 0;              // of blocks within three sigma + 0.5 %
    double medianSigma = 0;                 // relative
    double meanSquareZ = 0;                 // of blocks; 1 for an unbiased estimator of many pictures
    // Standard deviation of meanSquareZ for an unbiased estimator. Spatial reuse ties blocks together, so
    // that a picture has fewer independent ones than blocks.
    double meanSquareZSpread = 0;
    double worstZ = 0;   // largest |z| of a block
    size_t blocks = 0;
    double skewness = 0;   // of the pictures' luminance
};
Agreement compare(const SeedStatistics& picture, const ReferenceBlocks& reference);
void print(const char* what, const Agreement& a);

}   // namespace proof
