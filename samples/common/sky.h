// Environment maps: files, a built-in one, and the distributions that the reference draws from.
#pragma once

#include <string>
#include <vector>

#include "common/scene.h"

namespace samples {

// A .hdr or .exr file, or builtin:sky, a clear day with a sun of one texel. A map too large for an importance
// table is halved until it fits, with a warning. Throws std::runtime_error naming the file.
FloatImage loadSky(const std::string& nameOrPath, std::vector<std::string>& warnings);

// In sky.glsl, followed by the distributions.
struct SkyHeader {
    uint32_t texture = RS_NO_TEXTURE;
    float rotation = 0, scale = 0;
    uint32_t width = 0, height = 0;
};
std::vector<std::byte> skyTable(const Sky& sky, uint32_t texture);

}   // namespace samples
