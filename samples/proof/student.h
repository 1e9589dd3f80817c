// Student's distribution: a variance estimated from a few pictures is itself random.
#pragma once

namespace proof {

// The |t| that one variable with `freedom` degrees exceeds with probability `alpha`.
double studentQuantile(double alpha, double freedom);

// What unbiased estimators keep to with probability 1 - kAlpha, in all cells together (Bonferroni).
inline constexpr double kAlpha = 0.001;
inline double studentBound(double cells, double freedom) { return studentQuantile(kAlpha / cells, freedom); }

}   // namespace proof
