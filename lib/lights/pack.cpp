#include <lights/pack.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include <glm/glm.hpp>

namespace restir {
namespace {

using gpu::vec3;

vec3 toVec3(const float (&v)[3]) { return {v[0], v[1], v[2]}; }
vec3 minus(vec3 a, vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
glm::dvec3 toDouble(const float (&v)[3]) { return {double(v[0]), double(v[1]), double(v[2])}; }
float luminance(const float (&c)[3]) { return 0.2126f * c[0] + 0.7152f * c[1] + 0.0722f * c[2]; }

// 0 times infinity is not a number, either.
bool isFinite(const float (&v)[3]) { return 0 * v[0] + 0 * v[1] + 0 * v[2] == 0; }

// The longest edge whose squares and products stay finite in the shaders.
constexpr float kLongestEdge = 1e9f;

bool edgeFits(const float (&a)[3], const float (&b)[3]) {
    const float x = b[0] - a[0], y = b[1] - a[1], z = b[2] - a[2];
    return x * x + y * y + z * z <= kLongestEdge * kLongestEdge;
}

// The dot product is finite for all floats.
bool hasDirection(const Light& light) {
    const glm::dvec3 d = toDouble(light.direction);
    return isFinite(light.direction) && glm::dot(d, d) > 0;
}

// Null if the light is good, else the field that is not.
const char* badField(const Light& light, const LightLimits& limits) {
    if (light.id >= limits.lights) return "id (at least LightTableDesc::maxLights)";
    if (light.kind > LightKind::Directional) return "kind";
    const auto& emission = light.emission;
    if (!isFinite(emission) || std::min({emission[0], emission[1], emission[2]}) < 0) return "emission";
    if (light.kind != LightKind::Directional && !isFinite(light.position)) return "position";
    if (light.kind == LightKind::Triangle) {
        if (!edgeFits(light.position, light.vertex1)) return "vertex1 (not finite, or too far from position)";
        if (!edgeFits(light.position, light.vertex2)) return "vertex2 (not finite, or too far from position)";
        if (!std::isfinite(light.meanLuminance)) return "meanLuminance";
        if (light.texture == RS_NO_TEXTURE && light.meanLuminance == 0 && luminance(light.emission) > 0)
            return "meanLuminance (0, but it emits)";
        if (light.texture != RS_NO_TEXTURE && light.texture >= limits.textures)
            return "texture (at least ContextDesc::maxTextures)";
        const auto& uv = light.uv;
        if (0 * uv[0][0] + 0 * uv[0][1] + 0 * uv[1][0] + 0 * uv[1][1] + 0 * uv[2][0] + 0 * uv[2][1] != 0) return "uv";
        return nullptr;
    }
    if (light.kind != LightKind::Point && !hasDirection(light)) return "direction";
    if (light.kind != LightKind::Directional && (!std::isfinite(light.range) || light.range < 0)) return "range";
    if (light.kind == LightKind::Spot &&
        !(light.innerCone >= 0 && light.innerCone < light.outerCone && light.outerCone <= 1.5708f))
        return "innerCone / outerCone";
    return nullptr;
}

// By which the light is chosen, times a factor of its kind and shape: restir/lights/power.glsl.
float meanLuminance(const Light& light) {
    if (light.kind == LightKind::Triangle && light.meanLuminance >= 0) return light.meanLuminance;
    return luminance(light.emission);
}

vec3 axisOf(const Light& light) {
    const glm::dvec3 unit = glm::normalize(toDouble(light.direction));
    return {float(unit.x), float(unit.y), float(unit.z)};
}

gpu::RsPackedLight packLight(const Light& light) {
    gpu::RsPackedLight packed{};
    packed.position = toVec3(light.position);
    packed.emission = toVec3(light.emission);
    packed.selection = meanLuminance(light);
    uint32_t kind = RS_LIGHT_TRIANGLE, texture = RS_LIGHT_NO_TEXTURE;
    switch (light.kind) {
        case LightKind::Triangle:
            packed.edge1 = minus(toVec3(light.vertex1), packed.position);
            packed.edge2 = minus(toVec3(light.vertex2), packed.position);
            if (light.texture != RS_NO_TEXTURE) texture = light.texture;
            packed.uv0 = {light.uv[0][0], light.uv[0][1]};
            packed.uv1 = {light.uv[1][0], light.uv[1][1]};
            packed.uv2 = {light.uv[2][0], light.uv[2][1]};
            break;
        case LightKind::Point:
            kind = RS_LIGHT_POINT;
            packed.edge2 = {0, 0, light.range};
            break;
        case LightKind::Spot: {
            kind = RS_LIGHT_SPOT;
            packed.edge1 = axisOf(light);
            const float outer = std::cos(light.outerCone);
            const float scale = 1 / std::max(0.001f, std::cos(light.innerCone) - outer);
            packed.edge2 = {scale, -outer * scale, light.range};
            break;
        }
        case LightKind::Directional:
            kind = RS_LIGHT_DIRECTIONAL;
            packed.edge1 = axisOf(light);
            break;
    }
    packed.kindAndTexture = kind | (light.twoSided ? RS_LIGHT_TWO_SIDED : 0) | texture << RS_LIGHT_TEXTURE_SHIFT;
    return packed;
}

// Bits that are not set below `end`.
template <class Visit>
void forEachGap(std::span<const uint64_t> bits, uint32_t end, const Visit& visit) {
    for (uint32_t word = 0; word * 64 < end; ++word)
        for (uint64_t gaps = ~bits[word]; gaps != 0; gaps &= gaps - 1) {
            const uint32_t i = word * 64 + uint32_t(std::countr_zero(gaps));
            if (i >= end) return;
            visit(i);
        }
}

}   // namespace

Status LightPacker::pack(const MessageSink& sink, std::span<const Light> lights, gpu::RsPackedLight* out,
                         PackedLights& packed) {
    std::fill(seen_.begin(), seen_.end(), 0);
    PackedLights found;
    for (size_t i = 0; i < lights.size(); ++i) {
        const Light& light = lights[i];
        if (const char* field = badField(light, limits_))
            return refuse(sink, "restir: light %zu (id %u): bad %s", i, light.id, field);
        const uint64_t bit = uint64_t{1} << light.id % 64;
        if (seen_[light.id / 64] & bit)
            return refuse(sink, "restir: light %zu: id %u names another light already", i, light.id);
        seen_[light.id / 64] |= bit;
        found.count = std::max(found.count, light.id + 1);
        if (light.texture != RS_NO_TEXTURE) found.textures = std::max(found.textures, light.texture + 1);
        found.directional |= light.kind == LightKind::Directional;
        if (out) out[light.id] = packLight(light);
    }
    if (out && found.count != lights.size()) forEachGap(seen_, found.count, [&](uint32_t id) { out[id] = {}; });
    packed = found;
    return Status::Ok;
}

}   // namespace restir
