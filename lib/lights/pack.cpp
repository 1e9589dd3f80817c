#include <lights/pack.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

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
constexpr auto kLongestEdge = float(RS_LIGHT_LONGEST);
constexpr auto kLargest = float(RS_LIGHT_LARGEST);

bool edgeFits(const float (&a)[3], const float (&b)[3]) {
    const float x = b[0] - a[0], y = b[1] - a[1], z = b[2] - a[2];
    return x * x + y * y + z * z <= kLongestEdge * kLongestEdge;
}

// The dot product is finite for all floats.
bool hasDirection(const Light& light) {
    const glm::dvec3 d = toDouble(light.direction);
    return isFinite(light.direction) && glm::dot(d, d) > 0;
}

bool isPlanar(LightKind kind) { return kind == LightKind::Triangle || kind == LightKind::Rectangle; }
bool isRound(LightKind kind) {
    return kind == LightKind::Sphere || kind == LightKind::Capsule || kind == LightKind::Disk;
}
bool isInfinite(LightKind kind) { return kind == LightKind::Directional || kind == LightKind::Environment; }
bool isPunctual(LightKind kind) { return kind == LightKind::Point || kind == LightKind::Spot; }
bool usesTexture(const Light& light) {
    const bool may = isPlanar(light.kind) || isPunctual(light.kind) || light.kind == LightKind::Environment;
    return light.texture != RS_NO_TEXTURE && may;
}

const char* badPlanarField(const Light& light, const LightLimits& limits) {
    if (!edgeFits(light.position, light.vertex1)) return "vertex1 (not finite, or too far from position)";
    if (!edgeFits(light.position, light.vertex2)) return "vertex2 (not finite, or too far from position)";
    if (!(std::abs(light.meanLuminance) <= kLargest)) return "meanLuminance (not finite, or above 1e30)";
    if (light.texture == RS_NO_TEXTURE && light.meanLuminance == 0 && luminance(light.emission) > 0)
        return "meanLuminance (0, but it emits)";
    if (light.texture != RS_NO_TEXTURE && light.texture >= limits.textures)
        return "texture (at least ContextDesc::maxTextures)";
    const auto& uv = light.uv;
    if (0 * uv[0][0] + 0 * uv[0][1] + 0 * uv[1][0] + 0 * uv[1][1] + 0 * uv[2][0] + 0 * uv[2][1] != 0)
        return "uv";
    return nullptr;
}

const char* badRoundField(const Light& light) {
    if (!(light.radius >= 0 && light.radius <= kLongestEdge)) return "radius";
    if (light.kind == LightKind::Disk && !hasDirection(light)) return "direction";
    if (light.kind == LightKind::Capsule && !edgeFits(light.position, light.vertex1))
        return "vertex1 (not finite, or too far from position)";
    return nullptr;
}

const char* badRotation(const Light& light) {
    double squared = 0;
    for (float q : light.rotation) squared += double(q) * double(q);
    return std::abs(squared - 1) < 1e-3 ? nullptr : "rotation (not a unit quaternion)";
}

const char* badEnvironmentField(const Light& light, const LightLimits& limits) {
    if (limits.environment < 0) return "kind (LightTable::uploadEnvironment comes first)";
    if (light.texture >= limits.textures)
        return "texture (an environment needs one, below ContextDesc::maxTextures)";
    return badRotation(light);
}

glm::dmat3 axesOf(const Light& light) {
    const float* q = light.rotation;
    return glm::mat3_cast(glm::normalize(glm::dquat(double(q[3]), double(q[0]), double(q[1]), double(q[2]))));
}

const char* badProfileField(const Light& light, const LightLimits& limits) {
    if (light.texture == RS_NO_TEXTURE) return nullptr;
    if (light.texture >= limits.textures) return "texture (at least ContextDesc::maxTextures)";
    if (!(std::abs(light.meanLuminance) <= kLargest)) return "meanLuminance (not finite, or above 1e30)";
    if (const char* bad = badRotation(light)) return bad;
    const bool along =
        light.kind == LightKind::Spot &&
        std::abs(glm::dot(axesOf(light)[0], glm::normalize(toDouble(light.direction)))) > 0.9999;
    return along ? "rotation (turns the profile's x along direction)" : nullptr;
}

// Null if the light is good, else the field that is not.
const char* badField(const Light& light, const LightLimits& limits) {
    if (light.id >= limits.lights) return "id (at least LightTableDesc::maxLights)";
    if (light.id < limits.first) return "id (below LightTableDesc::meshLights)";
    if (light.kind > LightKind::Environment) return "kind";
    const auto& emission = light.emission;
    if (!isFinite(emission) || std::min({emission[0], emission[1], emission[2]}) < 0) return "emission";
    if (std::max({emission[0], emission[1], emission[2]}) > kLargest) return "emission (above 1e30)";
    if (!isInfinite(light.kind) && !isFinite(light.position)) return "position";
    if (isPlanar(light.kind)) return badPlanarField(light, limits);
    if (isRound(light.kind)) return badRoundField(light);
    if (light.kind == LightKind::Environment) return badEnvironmentField(light, limits);
    if (light.kind != LightKind::Point && !hasDirection(light)) return "direction";
    if (light.kind == LightKind::Directional)
        return light.angularRadius >= 0 && light.angularRadius <= 1.5708f ? nullptr : "angularRadius";
    if (!std::isfinite(light.range) || light.range < 0) return "range";
    if (light.kind == LightKind::Spot &&
        !(light.innerCone >= 0 && light.innerCone < light.outerCone && light.outerCone <= 1.5708f))
        return "innerCone / outerCone";
    return badProfileField(light, limits);
}

// By which the light is chosen, times a factor of its kind and shape: restir/lights/power.glsl.
float meanLuminance(const Light& light, const LightLimits& limits) {
    const bool given = isPlanar(light.kind) || (isPunctual(light.kind) && usesTexture(light));
    if (given && light.meanLuminance >= 0) return light.meanLuminance;
    if (light.kind == LightKind::Environment)
        return float(std::min(double(luminance(light.emission)) * limits.environment, 3e38));
    return luminance(light.emission);
}

vec3 toVec3(const glm::dvec3& v) { return {float(v.x), float(v.y), float(v.z)}; }
vec3 axisOf(const Light& light) { return toVec3(glm::normalize(toDouble(light.direction))); }

void packDisk(const Light& light, gpu::RsPackedLight& packed) {
    const glm::dvec3 n = glm::normalize(toDouble(light.direction));
    const glm::dvec3 x =
        glm::normalize(glm::cross(std::abs(n.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0), n));
    packed.edge1 = toVec3(double(light.radius) * x);
    packed.edge2 = toVec3(double(light.radius) * glm::cross(n, x));
}

void packEnvironment(const Light& light, gpu::RsPackedLight& packed) {
    const glm::dmat3 axes = axesOf(light);
    packed.position = toVec3(axes[0]);
    packed.edge1 = toVec3(axes[1]);
    packed.edge2 = toVec3(axes[2]);
}

void packProfile(const Light& light, gpu::RsPackedLight& packed) {
    const glm::dmat3 axes = axesOf(light);
    const bool spot = light.kind == LightKind::Spot;
    const glm::dvec3 axis = spot ? glm::normalize(toDouble(light.direction)) : -axes[2];
    const glm::dvec3 x = glm::normalize(axes[0] - glm::dot(axes[0], axis) * axis);
    packed.edge1 = toVec3(axis);
    packed.uv0 = {float(x.x), float(x.y)};
    packed.uv1 = {float(x.z), 0};
}

// All but position, emission and texture. Returns RS_LIGHT_*.
uint32_t packShape(const Light& light, gpu::RsPackedLight& packed) {
    switch (light.kind) {
        case LightKind::Triangle:
        case LightKind::Rectangle:
            packed.edge1 = minus(toVec3(light.vertex1), packed.position);
            packed.edge2 = minus(toVec3(light.vertex2), packed.position);
            packed.uv0 = {light.uv[0][0], light.uv[0][1]};
            packed.uv1 = {light.uv[1][0], light.uv[1][1]};
            packed.uv2 = {light.uv[2][0], light.uv[2][1]};
            return light.kind == LightKind::Triangle ? RS_LIGHT_TRIANGLE : RS_LIGHT_RECTANGLE;
        case LightKind::Capsule:
            packed.edge1 = minus(toVec3(light.vertex1), packed.position);
            [[fallthrough]];
        case LightKind::Sphere:
            packed.edge2 = {light.radius, 0, 0};
            return RS_LIGHT_CAPSULE;
        case LightKind::Disk:
            packDisk(light, packed);
            return RS_LIGHT_DISK;
        case LightKind::Point:
            packed.edge2 = {0, 0, light.range};
            return RS_LIGHT_POINT;
        case LightKind::Spot: {
            packed.edge1 = axisOf(light);
            const float outer = std::cos(light.outerCone);
            const float scale = 1 / std::max(0.001f, std::cos(light.innerCone) - outer);
            packed.edge2 = {scale, -outer * scale, light.range};
            return RS_LIGHT_SPOT;
        }
        case LightKind::Directional: {
            const double half = std::sin(0.5 * double(light.angularRadius));
            packed.edge1 = axisOf(light);
            packed.edge2 = {float(std::min(2 * half * half, 1.0)), 0, 0};
            return RS_LIGHT_DIRECTIONAL;
        }
        case LightKind::Environment:
            packEnvironment(light, packed);
            return RS_LIGHT_ENVIRONMENT;
    }
    return RS_LIGHT_NONE;
}

gpu::RsPackedLight packLight(const Light& light, const LightLimits& limits) {
    gpu::RsPackedLight packed{};
    if (!isInfinite(light.kind)) packed.position = toVec3(light.position);   // theirs may be anything
    packed.emission = toVec3(light.emission);
    packed.selection = meanLuminance(light, limits);
    const uint32_t kind = packShape(light, packed);
    if (isPunctual(light.kind) && usesTexture(light)) packProfile(light, packed);
    const bool sides = light.twoSided && (isPlanar(light.kind) || light.kind == LightKind::Disk);
    const uint32_t texture = usesTexture(light) ? light.texture : RS_LIGHT_NO_TEXTURE;
    packed.kindAndTexture = kind | (sides ? RS_LIGHT_TWO_SIDED : 0) | texture << RS_LIGHT_TEXTURE_SHIFT;
    return packed;
}

// Rays that miss everything find it.
bool isBehindMisses(const Light& light) {
    return light.kind == LightKind::Environment ||
           (light.kind == LightKind::Directional && light.angularRadius > 0);
}

// Bits that are not set from `begin` on and below `end`.
template <class Visit>
void forEachGap(std::span<const uint64_t> bits, uint32_t begin, uint32_t end, const Visit& visit) {
    for (uint32_t word = begin / 64; word * 64 < end; ++word)
        for (uint64_t gaps = ~bits[word]; gaps != 0; gaps &= gaps - 1) {
            const uint32_t i = word * 64 + uint32_t(std::countr_zero(gaps));
            if (i >= end) return;
            if (i >= begin) visit(i);
        }
}

}   // namespace

Status LightPacker::pack(const MessageSink& sink, std::span<const Light> lights, gpu::RsPackedLight* out,
                         PackedLights& packed) {
    std::fill(seen_.begin(), seen_.end(), 0);
    PackedLights found;
    uint32_t behindMisses = 0;
    for (size_t i = 0; i < lights.size(); ++i) {
        const Light& light = lights[i];
        if (const char* field = badField(light, limits_))
            return refuse(sink, "restir: light %zu (id %u): bad %s", i, light.id, field);
        const uint64_t bit = uint64_t{1} << light.id % 64;
        if (seen_[light.id / 64] & bit)
            return refuse(sink, "restir: light %zu: id %u names another light already", i, light.id);
        seen_[light.id / 64] |= bit;
        found.count = std::max(found.count, light.id + 1);
        if (usesTexture(light)) found.textures = std::max(found.textures, light.texture + 1);
        found.infinite |= isInfinite(light.kind);
        if (isBehindMisses(light)) {
            if (behindMisses == RS_INFINITE_LIGHTS)
                return refuse(sink,
                              "restir: light %zu (id %u): more than %u lights at infinity have an extent", i,
                              light.id, RS_INFINITE_LIGHTS);
            found.found[behindMisses++] = light.id;
        }
        if (out) out[light.id - limits_.first] = packLight(light, limits_);
    }
    if (out && found.count != lights.size())
        forEachGap(seen_, limits_.first, found.count, [&](uint32_t id) { out[id - limits_.first] = {}; });
    packed = found;
    return Status::Ok;
}

}   // namespace restir
