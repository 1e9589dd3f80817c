#include "common/sky.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <memory>
#include <numbers>
#include <span>
#include <stdexcept>

#include <stb/stb_image.h>
#include <glm/glm.hpp>

namespace samples {
namespace {

constexpr size_t kMostTexels = size_t{4096} * 2048;
constexpr float kPi = std::numbers::pi_v<float>;

FloatImage readHdr(const std::string& path) {
    int width = 0, height = 0, channels = 0;
    if (!std::ifstream(path, std::ios::binary)) throw std::runtime_error(path + ": cannot be read");
    if (!stbi_is_hdr(path.c_str())) throw std::runtime_error(path + ": is not a Radiance .hdr file");
    const std::unique_ptr<float, void (*)(void*)> pixels(
        stbi_loadf(path.c_str(), &width, &height, &channels, 3), stbi_image_free);
    if (!pixels) throw std::runtime_error(path + ": cannot be read: " + stbi_failure_reason());
    const size_t count = static_cast<size_t>(width) * static_cast<size_t>(height) * 3;
    return {
        static_cast<uint32_t>(width), static_cast<uint32_t>(height), {pixels.get(), pixels.get() + count}};
}

void checkTexels(const std::string& path, FloatImage& map) {
    for (size_t i = 0; i < map.rgb.size(); ++i) {
        float& value = map.rgb[i];
        if (!std::isfinite(value)) {
            const size_t texel = i / 3;
            throw std::runtime_error(path + ": is not finite at texel " + std::to_string(texel % map.width) +
                                     ", " + std::to_string(texel / map.width));
        }
        value = std::max(value, 0.0f);
    }
}

// Means of 2 x 2 texels; the last row or column of an odd size stands for itself.
FloatImage halved(const FloatImage& map) {
    FloatImage half{(map.width + 1) / 2, (map.height + 1) / 2, {}};
    for (uint32_t y = 0; y < half.height; ++y)
        for (uint32_t x = 0; x < half.width; ++x)
            for (uint32_t c = 0; c < 3; ++c) {
                float sum = 0;
                for (uint32_t i = 0; i < 4; ++i) {
                    const size_t column = std::min(2 * x + i % 2, map.width - 1),
                                 row = std::min(2 * y + i / 2, map.height - 1);
                    sum += map.rgb[3 * (row * map.width + column) + c];
                }
                half.rgb.push_back(0.25f * sum);
            }
    return half;
}

// Blue above, pale at the horizon, brown below, brighter around the sun, which is a texel and 100,000 times
// the sky.
FloatImage clearDay() {
    constexpr uint32_t kWidth = 512, kHeight = 256, kSunX = 100, kSunY = 76;
    const auto direction = [](uint32_t x, uint32_t y) {
        const float phi = 2 * kPi * ((static_cast<float>(x) + 0.5f) / kWidth - 0.5f);
        const float theta = kPi * (static_cast<float>(y) + 0.5f) / kHeight;
        return glm::vec3(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi));
    };
    const glm::vec3 sun = direction(kSunX, kSunY);
    FloatImage map{kWidth, kHeight, {}};
    for (uint32_t y = 0; y < kHeight; ++y)
        for (uint32_t x = 0; x < kWidth; ++x) {
            const glm::vec3 d = direction(x, y);
            const float up = std::max(d.y, 0.0f), cosine = std::max(glm::dot(d, sun), 0.0f);
            glm::vec3 color =
                glm::mix(glm::vec3(0.65f, 0.75f, 0.9f), glm::vec3(0.12f, 0.26f, 0.6f), std::sqrt(up));
            color += std::pow(cosine, 60.0f) * glm::vec3(1.2f, 0.9f, 0.6f);
            if (d.y < 0) color = glm::vec3(0.12f, 0.1f, 0.08f);
            if (x == kSunX && y == kSunY) color = glm::vec3(60000, 52000, 42000);
            for (int c = 0; c < 3; ++c) map.rgb.push_back(color[c]);
        }
    return map;
}

bool endsWith(const std::string& text, const std::string& end) {
    return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

// Cumulative shares of `weights`, from 0 to 1; uniform where there is no weight.
void appendDistribution(std::vector<float>& out, const std::vector<double>& weights) {
    double all = 0, sum = 0;
    for (const double w : weights) all += w;
    out.push_back(0);
    for (size_t i = 0; i < weights.size(); ++i) {
        sum += all > 0 ? weights[i] / all : 1.0 / static_cast<double>(weights.size());
        out.push_back(i + 1 == weights.size() ? 1.0f : static_cast<float>(sum));
    }
}

}   // namespace

FloatImage loadSky(const std::string& nameOrPath, std::vector<std::string>& warnings) {
    if (nameOrPath == "builtin:sky") return clearDay();
    const bool hdr = endsWith(nameOrPath, ".hdr"), exr = endsWith(nameOrPath, ".exr");
    if (!hdr && !exr)
        throw std::runtime_error(nameOrPath + ": an environment map is a .hdr or .exr file, or builtin:sky");
    FloatImage map = hdr ? readHdr(nameOrPath) : readExr(nameOrPath);
    checkTexels(nameOrPath, map);
    while (size_t{map.width} * map.height > kMostTexels) {
        map = halved(map);
        warnings.push_back(nameOrPath + ": reduced to " + std::to_string(map.width) + "x" +
                           std::to_string(map.height));
    }
    return map;
}

std::vector<std::byte> skyTable(const Sky& sky, uint32_t texture) {
    const FloatImage& map = sky.map;
    SkyHeader header;
    if (!map.rgb.empty()) header = {texture, sky.rotation, sky.scale, map.width, map.height};
    std::vector<double> rows;
    std::vector<float> columns, distributions;
    for (uint32_t y = 0; y < header.height; ++y) {
        // Brightest of a texel and those around it, which a linear filter mixes in.
        std::vector<double> row;
        for (uint32_t x = 0; x < header.width; ++x) {
            float most = 0;
            for (uint32_t i = 0; i < 9; ++i) {
                const size_t column = (x + i % 3 + header.width - 1) % header.width;
                const size_t line =
                    std::clamp(int64_t{y} + i / 3 - 1, int64_t{0}, int64_t{header.height} - 1);
                for (size_t c = 0; c < 3; ++c)
                    most = std::max(most, map.rgb[3 * (line * header.width + column) + c]);
            }
            row.push_back(static_cast<double>(most));
        }
        appendDistribution(columns, row);
        double sum = 0;
        for (const double w : row) sum += w;
        rows.push_back(sum * std::sin(std::numbers::pi * (y + 0.5) / header.height));
    }
    if (header.height > 0) appendDistribution(distributions, rows);
    distributions.insert(distributions.end(), columns.begin(), columns.end());
    const auto add = [](std::vector<std::byte>& to, std::span<const std::byte> more) {
        to.insert(to.end(), more.begin(), more.end());
    };
    std::vector<std::byte> bytes;
    add(bytes, std::as_bytes(std::span(&header, 1)));
    add(bytes, std::as_bytes(std::span(distributions)));
    return bytes;
}

}   // namespace samples
