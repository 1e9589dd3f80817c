#include "proof/measures.h"

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

double relativeError(const samples::FloatImage& image, const samples::FloatImage& reference) {
    const double floor = floorOf(reference);
    double sum = 0;
    size_t counted = 0;
    for (size_t i = 0; i < pixelsOf(image); ++i) {
        const double r = luminance(reference, i), d = luminance(image, i) - r;
        if (r <= 0) continue;
        sum += d * d / (r * r + floor);
        ++counted;
    }
    return counted > 0 ? sum / double(counted) : 0;
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
