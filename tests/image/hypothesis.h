// When a picture counts as unbiased: bounds from Student's distribution, since a variance estimated from a few
// pictures is itself random.
#pragma once

#include <string>
#include <vector>

#include <restir/settings.h>
#include <support/block_statistics.h>

namespace tests {

// The |t| that one variable with `freedom` degrees exceeds with probability `alpha`.
double studentQuantile(double alpha, size_t freedom);

// What an unbiased estimator passes with probability 1 - kAlpha, in all cells together (Bonferroni).
inline constexpr double kAlpha = 0.001;
inline double studentBound(size_t cells, size_t pictures) {
    return studentQuantile(kAlpha / double(cells), pictures - 1);
}

// A picture that is known exactly.
ReferenceBlocks exactly(const samples::FloatImage& image);

// Many estimators against one truth. Every block and every channel of every estimator is a cell.
class Verdict {
public:
    Verdict(size_t estimators, size_t pictures) : estimators_(estimators), pictures_(pictures) {}

    void add(const std::string& name, const Agreement& a);   // expects what one must pass
    void expectUnitVariance() const;   // mean t^2 over all cells, against the mean of Student's distribution

private:
    size_t estimators_, pictures_;
    double squares_ = 0;
    size_t blocks_ = 0;
};

struct NamedSettings {
    std::string name;
    restir::Settings settings;
};
// Every combination that claims to be unbiased, next-event estimation and plain RIS included.
std::vector<NamedSettings> unbiasedSettings();

bool allFinite(const samples::FloatImage& image);
float largest(const samples::FloatImage& image);
// The largest |a - b| relative to the largest value of b.
double largestDifference(const samples::FloatImage& a, const samples::FloatImage& b);

}   // namespace tests
