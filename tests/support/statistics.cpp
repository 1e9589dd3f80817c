#include "support/statistics.h"

#include <cmath>
#include <limits>

namespace tests {

Mean meanOf(std::span<const double> values) {
    const double n = static_cast<double>(values.size());
    double sum = 0, squares = 0;
    for (double value : values) sum += value;
    const double mean = sum / n;
    for (double value : values) squares += (value - mean) * (value - mean);
    return {mean, std::sqrt(squares / (n - 1) / n)};
}

double chiSquareZ(std::span<const uint64_t> counts, std::span<const double> probabilities, uint64_t total) {
    constexpr double kLeast = 10;
    double chi = 0, bins = 0, pooledCount = 0, pooledExpected = 0, counted = 0, expectedSum = 0;
    const auto add = [&](double count, double expected) {
        chi += (count - expected) * (count - expected) / expected;
        bins += 1;
    };
    for (size_t i = 0; i < counts.size(); ++i) {
        const double count = static_cast<double>(counts[i]);
        const double expected = probabilities[i] * static_cast<double>(total);
        if (count > 0 && !(expected > 0)) return std::numeric_limits<double>::infinity();
        counted += count;
        expectedSum += expected;
        if (expected >= kLeast) {
            add(count, expected);
        } else {
            pooledCount += count;
            pooledExpected += expected;
        }
    }
    // Whatever no bin holds belongs to the pool.
    pooledCount += static_cast<double>(total) - counted;
    pooledExpected += static_cast<double>(total) - expectedSum;
    if (pooledExpected >= kLeast)
        add(pooledCount, pooledExpected);
    else if (pooledCount > 10 * kLeast)
        return std::numeric_limits<double>::infinity();
    const double freedom = bins - 1;
    if (freedom < 1) return 0;
    const double spread = 2 / (9 * freedom);
    return (std::cbrt(chi / freedom) - (1 - spread)) / std::sqrt(spread);
}

}   // namespace tests
