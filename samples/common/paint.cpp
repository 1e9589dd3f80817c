// Colours and noise for the textures of the built-in scenes.
#include <algorithm>
#include <cmath>

#include "mesh_builder.h"

namespace samples::build {

uint8_t encodeByte(float linear, bool srgb) {
    float v = std::clamp(linear, 0.0f, 1.0f);
    if (srgb) v = v <= 0.0031308f ? 12.92f * v : 1.055f * std::pow(v, 1 / 2.4f) - 0.055f;
    return static_cast<uint8_t>(std::lround(v * 255));
}

glm::vec3 hex(uint32_t rgb) {
    glm::vec3 color;
    for (int c = 0; c < 3; ++c) {
        const float encoded = static_cast<float>((rgb >> (16 - 8 * c)) & 255u) / 255;
        color[c] = encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
    }
    return color;
}

float noise(glm::vec2 p, uint32_t period, uint32_t seed) {
    const glm::vec2 cell = glm::floor(p);
    glm::vec2 t = p - cell;
    t = t * t * (3.0f - 2.0f * t);
    const auto corner = [&](int dx, int dy) {
        const auto wrap = [&](float v) {
            const auto n = static_cast<int>(period);
            return static_cast<uint32_t>(((static_cast<int>(v) % n) + n) % n);
        };
        const uint32_t x = wrap(cell.x + static_cast<float>(dx)), y = wrap(cell.y + static_cast<float>(dy));
        return static_cast<float>(hash(x + hash(y + hash(seed))) >> 8) * 0x1p-24f;
    };
    return glm::mix(glm::mix(corner(0, 0), corner(1, 0), t.x), glm::mix(corner(0, 1), corner(1, 1), t.x),
                    t.y);
}

float fractalNoise(glm::vec2 uv, uint32_t period, uint32_t seed) {
    float sum = 0, weight = 0.5f;
    for (uint32_t octave = 0; octave < 4; ++octave, weight *= 0.5f, period *= 2)
        sum += weight * noise(uv * static_cast<float>(period), period, seed + octave);
    return sum / 0.9375f;
}

}   // namespace samples::build
