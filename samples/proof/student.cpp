#include "proof/student.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace proof {
namespace {

// With t = sqrt(freedom) tan(angle) the density is cos(angle)^(freedom - 1) up to a constant.
double tailIntegral(double angle, double freedom) {
    constexpr int kSteps = 2000;   // Simpson
    // Beyond, the density is below e^-50 of its largest.
    const double end = std::min(0.5 * std::numbers::pi, angle + 10 / std::sqrt(freedom));
    const double h = (end - angle) / kSteps;
    double sum = 0;
    for (int i = 0; i <= kSteps; ++i) {
        const double weight = i == 0 || i == kSteps ? 1 : i % 2 == 1 ? 4 : 2;
        sum += weight * std::pow(std::max(std::cos(angle + i * h), 0.0), freedom - 1);
    }
    return sum * h / 3;
}

}   // namespace

double studentQuantile(double alpha, double freedom) {
    const double whole = tailIntegral(0, freedom);
    double low = 0, high = 0.5 * std::numbers::pi;
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (tailIntegral(middle, freedom) > alpha * whole ? low : high) = middle;
    }
    return std::sqrt(freedom) * std::tan(low);
}

}   // namespace proof
