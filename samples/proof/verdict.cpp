#include "proof/verdict.h"

#include <algorithm>
#include <cmath>

#include "proof/student.h"

namespace proof {
namespace {

constexpr double kMeanSquareLow = 0.8, kMeanSquareHigh = 1.2;   // never a sign of bias within
constexpr double kSurprising = 3.29;   // of a normal variable once in a thousand: outside, no sign of its absence either

// `value` over its mean 1 with standard deviation `spread`, as a normal variable: chi-square with 2 /
// spread^2 degrees, whose cube root is nearly normal (Wilson & Hilferty 1931).
double zOfMeanSquare(double value, double spread) {
    const double variance = spread * spread / 9;
    return (std::cbrt(value) - (1 - variance)) / std::sqrt(variance);
}

double worstMeanZ(const Agreement& a) {
    double worst = 0;
    const auto look = [&](double ratio, double error) {
        if (error > 0) worst = std::max(worst, std::abs(ratio) / error);
    };
    for (size_t c = 0; c < 3; ++c) look(a.channelRatio[c], a.channelError[c]);
    look(a.luminanceRatio.mean, a.luminanceRatio.error);
    return worst;
}

}   // namespace

const char* nameOf(Verdict verdict) {
    switch (verdict) {
        case Verdict::Unbiased:
            return "unbiased";
        case Verdict::Open:
            return "open";
        case Verdict::Biased:
            return "biased";
    }
    return "?";
}

double hypothesesOf(const Agreement& agreement) { return double(agreement.blocks) + 5; }

Judgement judge(const Agreement& agreement, double freedom, const Bounds& bounds) {
    Judgement result{.agreement = agreement};
    const double student = freedom > 2 ? freedom / (freedom - 2) : 1;   // the mean of t^2
    result.zBound = studentBound(bounds.hypotheses, freedom);
    result.worstMeanZ = worstMeanZ(agreement);
    result.meanSquare = agreement.meanSquareZ / student;
    result.meanSquareSpread = agreement.meanSquareZSpread;
    result.meanSquareZ = zOfMeanSquare(result.meanSquare, result.meanSquareSpread);
    const bool plain = result.meanSquare >= kMeanSquareLow && result.meanSquare <= kMeanSquareHigh;
    const bool far = std::max(agreement.worstZ, result.worstMeanZ) > result.zBound ||
                     (!plain && std::abs(result.meanSquareZ) > result.zBound);
    result.sequencesNeeded = 25 * agreement.skewness * agreement.skewness;
    const bool enough = freedom + 1 >= result.sequencesNeeded;
    if (enough && far) result.verdict = Verdict::Biased;
    const bool usual = plain || std::abs(result.meanSquareZ) <= kSurprising;
    if (enough && usual && !far && agreement.halfWidth <= bounds.halfWidth) result.verdict = Verdict::Unbiased;
    return result;
}

}   // namespace proof
