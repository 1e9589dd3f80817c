// When a picture counts as unbiased.
#pragma once

#include <string>
#include <vector>

#include <restir/settings.h>
#include <proof/block_statistics.h>
#include <proof/student.h>

namespace tests {

using namespace proof;   // the statistics

inline double studentBound(size_t cells, size_t pictures) {
    return proof::studentBound(double(cells), double(pictures - 1));
}

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
// Those of them that differ where nothing is hidden and all supports are the same: ClosedForm's Occluded has the others.
std::vector<NamedSettings> settingsInTheOpen();
std::vector<NamedSettings> pairwiseInTheOpen();   // and one of each other kind of weights
// Unbiased but for what they fill in.
std::vector<NamedSettings> checkerboards();

// What frames that light one pixel of each pair converge to on a plane, as checkerboards() do: every pixel is lit in every other
// one, and has the mean of its neighbours in the others. And of those that light one of each block, in turns.
samples::FloatImage halfBlurred(const samples::FloatImage& image);
samples::FloatImage blockBlurred(const samples::FloatImage& image);

bool allFinite(const samples::FloatImage& image);
float largest(const samples::FloatImage& image);
// Pixels that differ by more than rounding does.
size_t otherPixels(const samples::FloatImage& a, const samples::FloatImage& b);
// The largest |a - b| relative to the largest value of b.
double largestDifference(const samples::FloatImage& a, const samples::FloatImage& b);

}   // namespace tests
