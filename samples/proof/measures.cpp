#include "proof/measures.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace proof {
namespace {

size_t pixelsOf(const samples::FloatImage& image) { return image.rgb.size() / 3; }

// What the error's square at a pixel of luminance r is divided by, less r^2.
double floorOf(const samples::FloatImage& reference) {
    double sum = 0;
    size_t counted = 0;
    for (size_t i = 0; i < pixelsOf(reference); ++i) {
        const double r = luminance(reference, i);
        sum += r;
        if (r > 0) ++counted;
    }
    const double mean = counted > 0 ? sum / double(counted) : 0;
    return 0.01 * mean * mean;
}

}   // namespace

double luminance(const samples::FloatImage& image, size_t pixel) {
    const float* c = &image.rgb[3 * pixel];
    return 0.2126 * double(c[0]) + 0.7152 * double(c[1]) + 0.0722 * double(c[2]);
}

double trimmedError(const samples::FloatImage& image, const samples::FloatImage& reference, double share) {
    const double floor = floorOf(reference);
    std::vector<double> errors;
    for (size_t i = 0; i < pixelsOf(image); ++i) {
        const double r = luminance(reference, i), d = luminance(image, i) - r;
        if (r > 0) errors.push_back(d * d / (r * r + floor));
    }
    if (errors.empty()) return 0;
    const auto kept = std::max(size_t(share * double(errors.size())), size_t{1});
    const auto end = errors.begin() + std::ptrdiff_t(kept);
    if (end != errors.end()) std::nth_element(errors.begin(), end, errors.end());
    return std::accumulate(errors.begin(), end, 0.0) / double(kept);
}

double relativeError(const samples::FloatImage& image, const samples::FloatImage& reference) {
    return trimmedError(image, reference, 1);
}

void NoiseCorrelation::add(const FramePair& a, const FramePair& b, const samples::FloatImage& reference) {
    const double floor = floorOf(reference);
    for (size_t i = 0; i < pixelsOf(reference); ++i) {
        const double r = luminance(reference, i), scale = r * r + floor;
        if (r <= 0) continue;
        const double before = luminance(a.before, i) - luminance(b.before, i);
        const double last = luminance(a.last, i) - luminance(b.last, i);
        products_ += before * last / scale;
        squares_ += 0.5 * (before * before + last * last) / scale;
    }
}

}   // namespace proof
