// Statistics over 8x8 blocks of pictures. The sampling unit is a picture from an independent sequence: frames of one
// sequence are correlated (THEORY section 9).
#pragma once

#include <array>
#include <vector>

#include <common/image_io.h>

namespace tests {

inline constexpr uint32_t kBlock = 8;

// Block means of one picture; partial blocks at the right and bottom edges are left out.
struct Blocks {
    uint32_t columns = 0, rows = 0;
    std::vector<std::array<double, 3>> mean;
};
Blocks blocksOf(const samples::FloatImage& image);

double luminance(const std::array<double, 3>& rgb);

// Mean and variance of the mean over pictures, per block and for the whole.
class SeedStatistics {
public:
    // Blocks with `leftOut` set do not count; empty: all count.
    explicit SeedStatistics(std::vector<bool> leftOut = {}) : leftOut_(std::move(leftOut)) {}

    void add(const samples::FloatImage& image);

    size_t pictures() const { return count_; }
    size_t blocks() const { return sum_.size(); }
    bool counts(size_t block) const { return leftOut_.empty() || !leftOut_[block]; }
    double blockMean(size_t block) const { return sum_[block] / double(count_); }   // luminance
    double blockVariance(size_t block) const;                                       // of that mean
    std::array<double, 3> channelMean() const;
    std::array<double, 3> channelError() const;   // standard error of it

private:
    std::vector<bool> leftOut_;
    size_t count_ = 0;
    std::vector<double> sum_, squares_;
    std::vector<std::array<double, 3>> channels_;   // of each picture
};

// What a picture is held against: block luminances with the variance of each.
struct ReferenceBlocks {
    std::vector<double> mean, variance;
    std::array<double, 3> channelMean{};
    std::array<double, 3> channelError{};
};
// From two independent converged pictures. Pixels of one block share no noise, so the pixel differences give the
// variance of each block's mean.
ReferenceBlocks referenceFromPair(const samples::FloatImage& a, const samples::FloatImage& b,
                                  const SeedStatistics& mask);
ReferenceBlocks referenceFromSeeds(const SeedStatistics& seeds);

struct Agreement {
    std::array<double, 3> channelRatio{};   // picture / reference - 1
    std::array<double, 3> channelError{};   // standard error of it, both sides
    double fractionInside = 0;              // of blocks within three sigma + 0.5 %
    double medianSigma = 0;                 // relative
    double meanSquareZ = 0;                 // of blocks; 1 for an unbiased estimator
    double worstZ = 0;                      // largest |z| of a block
    size_t blocks = 0;
};
Agreement compare(const SeedStatistics& picture, const ReferenceBlocks& reference);
void print(const char* what, const Agreement& a);

}   // namespace tests
