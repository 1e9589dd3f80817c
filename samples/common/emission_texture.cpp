#include "common/emission_texture.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace samples {
namespace {

using restir::gpu::RsMaterial;

constexpr int kLeastSteps = 4, kMostSteps = 256;   // per triangle edge, when averaging
constexpr int64_t kMostTexels = 1 << 22;           // looked at for one triangle
constexpr float kMostDistance = 1 << 23;           // in texels: from there on floats cannot tell one from the next
// Chance of a triangle whose samples were all black though some texel under it is not, relative to that
// texel's light: small, but it keeps every estimator that uses it unbiased.
constexpr float kFloor = 0.05f;

int64_t wrapped(int64_t i, int64_t size, Wrap wrap) {
    if (wrap == Wrap::Clamp) return std::clamp<int64_t>(i, 0, size - 1);
    const int64_t period = wrap == Wrap::Mirror ? 2 * size : size;
    const int64_t r = ((i % period) + period) % period;
    return r < size ? r : period - 1 - r;
}

std::array<float, 256> linearFromByte(bool srgb) {
    std::array<float, 256> table{};
    for (size_t i = 0; i < table.size(); ++i) {
        const float c = static_cast<float>(i) / 255.0f;
        table[i] = !srgb ? c : c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f);
    }
    return table;
}

struct Opacity {
    const Image& image;
    const Texture& texture;
    float factor, cutoff;

    // Whether filtering next to this texel can see a hole.
    bool nearHole(int64_t x, int64_t y) const {
        for (int64_t dy = -1; dy <= 1; ++dy) {
            for (int64_t dx = -1; dx <= 1; ++dx) {
                const int64_t column = wrapped(x + dx, image.width, texture.wrapU);
                const int64_t row = wrapped(y + dy, image.height, texture.wrapV);
                const uint8_t alpha = image.rgba[static_cast<size_t>(4 * (row * image.width + column) + 3)];
                if (factor * static_cast<float>(alpha) / 255.0f < cutoff) return true;
            }
        }
        return false;
    }
};

// The source's texel nearest to texel (x, y) of an image of another size; white without a source.
std::array<uint8_t, 4> resample(const Image* source, const Image& size, int64_t x, int64_t y) {
    if (source == nullptr) return {255, 255, 255, 255};
    const int64_t column = (2 * x + 1) * source->width / (2 * int64_t{size.width});
    const int64_t row = (2 * y + 1) * source->height / (2 * int64_t{size.height});
    const uint8_t* texel = &source->rgba[static_cast<size_t>(4 * (row * source->width + column))];
    return {texel[0], texel[1], texel[2], texel[3]};
}

Image bake(const Opacity& opacity, const Image* emission) {
    Image result{.width = opacity.image.width, .height = opacity.image.height, .rgba = {}, .srgb = true};
    if (emission != nullptr) result.srgb = emission->srgb;
    result.rgba.resize(size_t{4} * result.width * result.height);
    size_t at = 0;
    for (int64_t y = 0; y < int64_t{result.height}; ++y) {
        for (int64_t x = 0; x < int64_t{result.width}; ++x, at += 4) {
            if (opacity.nearHole(x, y)) continue;
            const std::array<uint8_t, 4> texel = resample(emission, result, x, y);
            std::copy(texel.begin(), texel.end(), result.rgba.begin() + static_cast<std::ptrdiff_t>(at));
        }
    }
    return result;
}

// Whether a texel's filter footprint touches the triangle: every edge's half plane, moved out by a texel.
bool touches(const std::array<glm::vec2, 3>& corners, glm::vec2 point) {
    const glm::vec2 a = corners[1] - corners[0], b = corners[2] - corners[0];
    const float side = a.x * b.y - a.y * b.x < 0 ? -1.0f : 1.0f;
    for (size_t i = 0; i < 3; ++i) {
        const glm::vec2 edge = (corners[(i + 1) % 3] - corners[i]) * side;
        const glm::vec2 d = point - corners[i];
        if (edge.x * d.y - edge.y * d.x < -(std::abs(edge.x) + std::abs(edge.y))) return false;
    }
    return true;
}

}   // namespace

float luminance(const glm::vec3& color) { return glm::dot(color, glm::vec3(0.2126f, 0.7152f, 0.0722f)); }

void bakeMaskedEmission(SceneData& scene) {
    for (RsMaterial& material : scene.materials) {
        const bool masked = (material.flags & RS_MATERIAL_ALPHA_MASK) != 0;
        const bool emits = material.emission.x + material.emission.y + material.emission.z > 0;
        if (!masked || !emits || material.baseColorTexture == RS_NO_TEXTURE) continue;
        const Texture texture = scene.textures[material.baseColorTexture];
        const Image* emission = nullptr;
        if (material.emissionTexture != RS_NO_TEXTURE) {
            emission = &scene.images[scene.textures[material.emissionTexture].image];
        }
        Image baked = bake({scene.images[texture.image], texture, material.baseColor.w, material.alphaCutoff},
                           emission);
        material.emissionTexture = static_cast<uint32_t>(scene.textures.size());
        scene.textures.push_back(texture);
        scene.textures.back().image = static_cast<uint32_t>(scene.images.size());
        scene.images.push_back(std::move(baked));
    }
}

EmissionMap::EmissionMap(const SceneData& scene, const RsMaterial& material) {
    const Texture& texture = scene.textures[material.emissionTexture];
    const Image& image = scene.images[texture.image];
    width_ = image.width;
    height_ = image.height;
    wrapU_ = texture.wrapU;
    wrapV_ = texture.wrapV;
    const std::array<float, 256> linear = linearFromByte(image.srgb);
    const glm::vec3 factor(material.emission.x, material.emission.y, material.emission.z);
    luminance_.resize(size_t{image.width} * image.height);
    double sum = 0;
    for (size_t i = 0; i < luminance_.size(); ++i) {
        const uint8_t* texel = &image.rgba[4 * i];
        luminance_[i] = luminance(factor * glm::vec3(linear[texel[0]], linear[texel[1]], linear[texel[2]]));
        sum += luminance_[i];
    }
    average_ = static_cast<float>(sum / static_cast<double>(std::max<size_t>(luminance_.size(), 1)));
}

float EmissionMap::texel(int64_t x, int64_t y) const {
    return luminance_[static_cast<size_t>(wrapped(y, height_, wrapV_) * width_ + wrapped(x, width_, wrapU_))];
}

float EmissionMap::bilinear(glm::vec2 uv) const {
    const float x = uv.x * static_cast<float>(width_) - 0.5f, y = uv.y * static_cast<float>(height_) - 0.5f;
    const float fx = std::floor(x), fy = std::floor(y);
    const auto ix = static_cast<int64_t>(fx), iy = static_cast<int64_t>(fy);
    const float top = glm::mix(texel(ix, iy), texel(ix + 1, iy), x - fx);
    const float bottom = glm::mix(texel(ix, iy + 1), texel(ix + 1, iy + 1), x - fx);
    return glm::mix(top, bottom, y - fy);
}

float EmissionMap::mean(const glm::vec2 (&uv)[3]) const {
    const glm::vec2 size(static_cast<float>(width_), static_cast<float>(height_));
    const float longest = std::max({glm::length((uv[1] - uv[0]) * size), glm::length((uv[2] - uv[0]) * size),
                                    glm::length((uv[2] - uv[1]) * size)});
    float farthest = longest;
    for (const glm::vec2& corner : uv)
        farthest = std::max({farthest, std::abs(corner.x * size.x), std::abs(corner.y * size.y)});
    if (!(farthest < kMostDistance)) return average_;
    const int steps = std::clamp(static_cast<int>(std::ceil(longest)), kLeastSteps, kMostSteps);
    double sum = 0;   // at the centroids of steps^2 equal triangles
    for (int row = 0; row < steps; ++row) {
        for (int column = 0; column < 2 * (steps - row) - 1; ++column) {
            const float third = (column & 1) != 0 ? 2.0f / 3.0f : 1.0f / 3.0f;
            const float a = (static_cast<float>(column / 2) + third) / static_cast<float>(steps);
            const float b = (static_cast<float>(row) + third) / static_cast<float>(steps);
            sum += bilinear(uv[0] + a * (uv[1] - uv[0]) + b * (uv[2] - uv[0]));
        }
    }
    if (sum > 0) return static_cast<float>(sum / (static_cast<double>(steps) * steps));
    return kFloor * touched(uv);
}

// Mean of the texels that bilinear filtering can reach from the triangle.
float EmissionMap::touched(const glm::vec2 (&uv)[3]) const {
    const glm::vec2 size(static_cast<float>(width_), static_cast<float>(height_));
    const std::array corners = {uv[0] * size, uv[1] * size, uv[2] * size};
    const glm::vec2 low = glm::floor(glm::min(glm::min(corners[0], corners[1]), corners[2])) - 1.0f;
    const glm::vec2 high = glm::ceil(glm::max(glm::max(corners[0], corners[1]), corners[2])) + 1.0f;
    const auto x0 = static_cast<int64_t>(low.x), x1 = static_cast<int64_t>(high.x);
    const auto y0 = static_cast<int64_t>(low.y), y1 = static_cast<int64_t>(high.y);
    if ((x1 - x0) * (y1 - y0) > kMostTexels) return average_;
    double sum = 0;
    int64_t count = 0;
    for (int64_t y = y0; y < y1; ++y) {
        for (int64_t x = x0; x < x1; ++x) {
            if (!touches(corners, glm::vec2(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f)))
                continue;
            sum += texel(x, y);
            ++count;
        }
    }
    return count > 0 ? static_cast<float>(sum / static_cast<double>(count)) : 0.0f;
}

}   // namespace samples
