#include <lights/pack.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/glm.hpp>

#include <lights/alias.h>

namespace restir {
namespace {

using gpu::vec3;

vec3 toVec3(const float (&v)[3]) { return {v[0], v[1], v[2]}; }
vec3 minus(vec3 a, vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
glm::dvec3 toDouble(const float (&v)[3]) { return {double(v[0]), double(v[1]), double(v[2])}; }
double luminance(const float (&c)[3]) { return 0.2126 * double(c[0]) + 0.7152 * double(c[1]) + 0.0722 * double(c[2]); }

double areaOf(const Light& triangle) {
    const glm::dvec3 p = toDouble(triangle.position);
    return 0.5 * glm::length(glm::cross(toDouble(triangle.vertex1) - p, toDouble(triangle.vertex2) - p));
}

bool isFinite(const float (&v)[3]) { return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]); }

// The longest edge whose squares and products stay finite in the shaders.
constexpr float kLongestEdge = 1e9f;

bool edgeFits(const float (&a)[3], const float (&b)[3]) { return glm::length(toDouble(a) - toDouble(b)) <= double(kLongestEdge); }

// Null if the light is good, else the field that is not.
const char* badField(const Light& light, const LightLimits& limits) {
    if (light.id >= limits.lights) return "id (at least LightTableDesc::maxLights)";
    if (light.kind > LightKind::Directional) return "kind";
    for (float e : light.emission)
        if (!std::isfinite(e) || e < 0) return "emission";
    if (light.kind != LightKind::Directional && !isFinite(light.position)) return "position";
    if (light.kind == LightKind::Triangle) {
        if (!isFinite(light.vertex1)) return "vertex1";
        if (!isFinite(light.vertex2)) return "vertex2";
        if (!edgeFits(light.position, light.vertex1)) return "vertex1 (too far from position)";
        if (!edgeFits(light.position, light.vertex2)) return "vertex2 (too far from position)";
        if (!std::isfinite(light.meanLuminance)) return "meanLuminance";
        if (light.texture == RS_NO_TEXTURE && light.meanLuminance == 0 && luminance(light.emission) > 0)
            return "meanLuminance (0, but it emits)";
        if (light.texture != RS_NO_TEXTURE && light.texture >= limits.textures)
            return "texture (at least ContextDesc::maxTextures)";
        for (const auto& uv : light.uv)
            if (!std::isfinite(uv[0]) || !std::isfinite(uv[1])) return "uv";
        return nullptr;
    }
    if (light.kind != LightKind::Point && (!isFinite(light.direction) || !(glm::length(toDouble(light.direction)) > 0)))
        return "direction";
    if (light.kind != LightKind::Directional && (!std::isfinite(light.range) || light.range < 0)) return "range";
    if (light.kind == LightKind::Spot &&
        !(light.innerCone >= 0 && light.innerCone < light.outerCone && light.outerCone <= 1.5708f))
        return "innerCone / outerCone";
    return nullptr;
}

// Radiant power by luminance; directional lights wait for the extent of the others.
double powerOf(const Light& light) {
    constexpr double pi = std::numbers::pi;
    const double shine = luminance(light.emission);
    switch (light.kind) {
        case LightKind::Triangle: {
            const double mean = light.meanLuminance < 0 ? shine : double(light.meanLuminance);
            return pi * areaOf(light) * mean * (light.twoSided ? 2 : 1);
        }
        case LightKind::Point: return 4 * pi * shine;
        case LightKind::Spot: return 2 * pi * (1 - std::cos(0.5 * (light.innerCone + light.outerCone))) * shine;
        case LightKind::Directional: return shine;
    }
    return 0;
}

// Area of a disc that holds every finite light, at least that of the unit disc: what a directional light shines on.
double sceneArea(std::span<const Light> lights) {
    double low[3] = {1e300, 1e300, 1e300}, high[3] = {-1e300, -1e300, -1e300};
    bool any = false;
    for (const Light& light : lights) {
        if (light.kind == LightKind::Directional) continue;
        any = true;
        for (int i = 0; i < 3; ++i) {
            low[i] = std::min(low[i], double(light.position[i]));
            high[i] = std::max(high[i], double(light.position[i]));
        }
    }
    if (!any) return std::numbers::pi;
    double diagonal = 0;
    for (int i = 0; i < 3; ++i) diagonal += (high[i] - low[i]) * (high[i] - low[i]);
    return std::numbers::pi * std::max(1.0, 0.25 * diagonal);
}

gpu::RsPackedLight packLight(const Light& light) {
    gpu::RsPackedLight packed{};
    packed.position = toVec3(light.position);
    packed.emission = toVec3(light.emission);
    uint32_t kind = RS_LIGHT_TRIANGLE, texture = RS_LIGHT_NO_TEXTURE;
    const glm::dvec3 unit = glm::normalize(toDouble(light.direction));
    const vec3 axis{float(unit.x), float(unit.y), float(unit.z)};
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
            packed.edge1 = axis;
            const float scale = 1 / std::max(0.001f, std::cos(light.innerCone) - std::cos(light.outerCone));
            packed.edge2 = {scale, -std::cos(light.outerCone) * scale, light.range};
            break;
        }
        case LightKind::Directional:
            kind = RS_LIGHT_DIRECTIONAL;
            packed.edge1 = axis;
            break;
    }
    packed.kindAndTexture = kind | (light.twoSided ? RS_LIGHT_TWO_SIDED : 0) | texture << RS_LIGHT_TEXTURE_SHIFT;
    return packed;
}

Status check(const MessageSink& sink, const LightLimits& limits, std::span<const Light> lights, uint32_t& columns) {
    std::vector<bool> seen(limits.lights);
    columns = 0;
    for (size_t i = 0; i < lights.size(); ++i) {
        if (const char* field = badField(lights[i], limits))
            return refuse(sink, "restir: light %zu (id %u): bad %s", i, lights[i].id, field);
        if (seen[lights[i].id])
            return refuse(sink, "restir: light %zu: id %u names another light already", i, lights[i].id);
        seen[lights[i].id] = true;
        columns = std::max(columns, lights[i].id + 1);
    }
    return Status::Ok;
}

}   // namespace

Status packLights(const MessageSink& sink, const LightLimits& limits, std::span<const Light> lights, PackedLights& packed) {
    uint32_t columns = 0;
    if (Status s = check(sink, limits, lights, columns); s != Status::Ok) return s;
    const double area = sceneArea(lights);
    packed.lights.assign(columns, {});
    packed.textures = 0;
    std::vector<double> power(columns);
    for (const Light& light : lights) {
        packed.lights[light.id] = packLight(light);
        if (light.texture != RS_NO_TEXTURE) packed.textures = std::max(packed.textures, light.texture + 1);
        power[light.id] = powerOf(light) * (light.kind == LightKind::Directional ? area : 1);
    }
    packed.alias = makeAliasTable(power);
    const std::vector<double> probability = aliasProbabilities(packed.alias);
    for (size_t i = 0; i < probability.size(); ++i) packed.lights[i].selection = float(probability[i]);
    return Status::Ok;
}

}   // namespace restir
