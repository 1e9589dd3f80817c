// Hypothesis tests on what samplers and estimators return.
#pragma once

#include <cstdint>
#include <span>

namespace tests {

struct Mean {
    double mean = 0;
    double error = 0;   // standard error of the mean

    double z(double expected) const { return (mean - expected) / error; }
    double relativeError() const { return error / mean; }
};
Mean meanOf(std::span<const double> values);

// How surprising the counts are, in standard deviations of a normal variable (Wilson & Hilferty 1931 for
// Pearson's chi-square). `probabilities` may sum to less than 1: the rest is one more bin. Bins that expect
// fewer than ten are pooled. A count where the probability is 0 is infinitely surprising.
double chiSquareZ(std::span<const uint64_t> counts, std::span<const double> probabilities, uint64_t total);

}   // namespace tests
