// What a table of cells says of each estimator.
#pragma once

#include "proof/proof_file.h"

namespace proof {

enum class Verdict {
    Unbiased,   // every z inside the bound, z^2 as it should be, the confidence interval narrow enough
    Open,       // not enough sequences to say either
    Biased,
};
const char* nameOf(Verdict verdict);

// The bounds of a table: |z| of every block and every mean of all its cells together, by Bonferroni.
struct Bounds {
    double hypotheses = 1;      // blocks, three channels and the luminance of each cell, and its mean z^2
    double halfWidth = 0.005;   // that a 95 % confidence interval must have
};

struct Judgement {
    Agreement agreement;
    double zBound = 0;
    double worstMeanZ = 0;   // largest |z| of a channel or of the luminance
    // The mean of z^2 over the blocks, 1 being what Student's distribution has, and how surprising it is as a
    // z.
    double meanSquare = 0, meanSquareSpread = 0, meanSquareZ = 0;
    // Rare bright outliers make a mean skewed, and its z with it: it is near enough to Student's from 25
    // skewness^2 sequences on (Cochran 1977).
    double sequencesNeeded = 0;
    Verdict verdict = Verdict::Open;
};
Judgement judge(const Agreement& agreement, double freedom, const Bounds& bounds);

double hypothesesOf(const Agreement& agreement);
// The cells that can be judged: those with at least this many sequences.
inline constexpr size_t kLeastSequences = 8;

}   // namespace proof
