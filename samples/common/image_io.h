// Float pictures in and out.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace samples {

// Linear RGB, row 0 on top.
struct FloatImage {
    uint32_t width = 0, height = 0;
    std::vector<float> rgb;
    std::vector<float> alpha = {};   // empty, or one a pixel
};

// All throw std::runtime_error naming the file. Writers go through a temporary file beside the target and
// rename it, so that no partial file is ever left.
// With alpha, if there is one, as a channel A.
void writeExr(const std::string& path, const FloatImage& image);
FloatImage readExr(const std::string& path);
// Tone-mapped (exposure from the image's log-average luminance unless `exposure` > 0; a filmic curve; sRGB).
void writePng(const std::string& path, const FloatImage& image, float exposure = 0);
// Colours in [0, 1] as they are.
void writeColorsPng(const std::string& path, const FloatImage& image);

}   // namespace samples
