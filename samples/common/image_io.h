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
// The factor that brings the log-average luminance a little below middle gray. Pixels darker than a
// thousandth of the 90th percentile count as black, or a night sky's last glimmer would set the exposure.
float autoExposure(const FloatImage& image);
// Tone-mapped (autoExposure() unless `exposure` > 0; a filmic curve; sRGB: tone_map.glsl).
void writePng(const std::string& path, const FloatImage& image, float exposure = 0);
// Colours in [0, 1] as they are.
void writeColorsPng(const std::string& path, const FloatImage& image);

}   // namespace samples
