// What is said of single frames.
#pragma once

#include <common/image_io.h>

namespace proof {

double luminance(const samples::FloatImage& image, size_t pixel);

// mean((I - R)^2 / (R^2 + 0.01 mean(R)^2)) of luminances. Black pixels of R are left out: the emitters that a
// Prover blacks out, and the sky.
double relativeError(const samples::FloatImage& image, const samples::FloatImage& reference);
// The same of the pixels with the least error, a `share` in (0, 1] of all: without what single outliers do.
double trimmedError(const samples::FloatImage& image, const samples::FloatImage& reference, double share);

// Two frames of one sequence, one after the other.
struct FramePair {
    samples::FloatImage before, last;
};

// What is kept of a sequence.
struct Take {
    samples::FloatImage mean;   // of the frames that count
    FramePair end;
};

// How much of a frame's noise the next one repeats: the correlation of their errors, summed over the pixels,
// each in proportion to the reference as in relativeError(). The difference of two independent sequences has
// no error but noise, so that neither bias nor a moving picture counts.
class NoiseCorrelation {
public:
    NoiseCorrelation() = default;
    NoiseCorrelation(double products, double squares) : products_(products), squares_(squares) {}

    void add(const FramePair& a, const FramePair& b, const samples::FloatImage& reference);
    double value() const { return squares_ > 0 ? products_ / squares_ : 0; }
    double products() const { return products_; }
    double squares() const { return squares_; }

private:
    double products_ = 0, squares_ = 0;
};

}   // namespace proof
