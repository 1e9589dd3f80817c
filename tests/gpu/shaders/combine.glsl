#version 460
// One pixel's reuse per invocation: fresh candidates at surface 0 and at its neighbours, combined, then shaded. Lights
// are read from buffers; who sees which light is a table, so that the exact result is known.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "restir/bsdf/metallic_roughness.glsl"
#include "restir/di/candidates.glsl"
#include "restir/di/combine.glsl"
#include "restir/di/next_event.glsl"
#include "restir/di/shade.glsl"
#include "gpu/shaders/include/hooks.glsl"

#define SURFACES 6u
#define PLANT_DROP_EMPTY 1u       // rejects neighbours for being empty
#define PLANT_CURRENT_LIGHTS 2u   // weighs the history as if it had seen this frame's lights

struct TestSurface {
    vec3 position, normal, baseColor;
    uint visible;      // bit i: sees light i
    uint confidence;
};
layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) readonly buffer Parameters {
    RsDiConstants di;
    uint seed, neighbours, previous, planted, lightCount, nextEvent, averaged;
    TestSurface surfaces[SURFACES];   // 0 is the canonical
    vec3 centres[8];                  // of the lights, however they move
};
layout(set = 0, binding = 1, scalar) readonly buffer Lights { RsPackedLight lights[]; };
layout(set = 0, binding = 2, scalar) readonly buffer OldLights { RsPackedLight previousLights[]; };
layout(set = 0, binding = 3, scalar) readonly buffer Alias { RsAliasEntry alias[]; };
layout(set = 0, binding = 4, scalar) readonly buffer OldAlias { RsAliasEntry previousAlias[]; };
layout(set = 0, binding = 5, scalar) writeonly buffer Out { vec4 results[]; };

bool inPreviousFrame = false;   // while the history's own candidates are drawn
RsReservoir reservoirs[SURFACES];

RsPackedLight rsLoadPreviousLight(uint id) {
    if ((planted & PLANT_CURRENT_LIGHTS) != 0u && !inPreviousFrame) return lights[id];
    return previousLights[id];
}
RsPackedLight rsLoadLight(uint id) {
    if (inPreviousFrame) return previousLights[id];
    return lights[id];
}
RsAliasEntry rsLoadAlias(uint column) {
    if (inPreviousFrame) return previousAlias[column];
    return alias[column];
}

RsSurface surfaceOf(uint i) {
    RsSurface s;
    s.valid = true;
    s.depth = 1e-3;   // rays start right on the surface
    s.position = surfaces[i].position;
    s.view = surfaces[i].normal;
    s.normal = s.view;
    s.geometricNormal = s.view;
    s.baseColor = surfaces[i].baseColor;
    s.roughness = 1.0;
    s.metalness = 0.0;
    s.specular = 0.0;
    s.materialId = i;
    return s;
}
vec3 rsBridgeBsdf(RsSurface s, vec3 light) { return rsBsdf(s, light); }
float rsBridgeBsdfPdf(RsSurface s, vec3 light) { return rsPdfBsdf(s, light); }
RsLobes rsBridgeLobes(RsSurface s, vec3 light) { return rsBsdfLobes(s, light); }
bool rsWantsLobes() { return false; }
vec3 rsBridgeSampleBsdf(RsSurface s, vec3 u) { return rsSampleBsdf(s, u); }
RsNeighbour rsLoadNeighbour(RsNeighbourhood where, uint i) {
    return RsNeighbour(surfaceOf(i + 1u), reservoirs[i + 1u], previous != 0u);
}

// Surfaces and lights are told apart by where rays begin and end.
bool sees(vec3 origin, uint light) {
    uint from = 0u;
    for (uint i = 1u; i < SURFACES; ++i)
        if (distance(surfaces[i].position, origin) < distance(surfaces[from].position, origin)) from = i;
    return (surfaces[from].visible >> light & 1u) != 0u;
}
bool rsOccluded(vec3 origin, vec3 direction, float tmax, bool previous) {
    vec3 end = origin + direction * tmax;
    uint light = 0u;
    for (uint i = 1u; i < lightCount; ++i)
        if (distance(centres[i], end) < distance(centres[light], end)) light = i;
    return !sees(origin, light);
}
// Triangles only, as in a real scene (Moeller & Trumbore 1997).
RsHit rsClosestHit(vec3 origin, vec3 direction, float tmax) {
    RsHit hit = RsHit(-1.0, 0u, 0u, vec2(0.0));
    for (uint i = 0u; i < lightCount; ++i) {
        RsPackedLight light = rsLoadLight(i);
        if (rsLightKind(light) != RS_LIGHT_TRIANGLE) continue;
        vec3 p = cross(direction, light.edge2), to = origin - light.position, q = cross(to, light.edge1);
        float determinant = dot(light.edge1, p);
        vec2 uv = vec2(dot(to, p), dot(direction, q)) / determinant;
        float t = dot(light.edge2, q) / determinant;
        if (!(uv.x >= 0.0 && uv.y >= 0.0 && uv.x + uv.y <= 1.0 && t > 0.0)) continue;
        if (hit.t < 0.0 || t < hit.t) hit = RsHit(t, 0u, i, uv);
    }
    if (hit.t > 0.0 && !sees(origin, hit.primitive)) hit.t = -1.0;
    return hit;
}
uint rsBridgeLight(RsHit hit) { return hit.primitive; }
uint rejected = 0u;
void rsOnRejectedWeight() { rejected++; }

void main() {
    uint i = gl_GlobalInvocationID.x;
    RsRandom random = rsRandom(uvec2(i & 511u, i >> 9u), seed, 0u);
    if (nextEvent != 0u) {
        results[i] = vec4(rsDiNextEvent(surfaceOf(0u), lightCount, di.lightCandidates, random).radiance, 0.0);
        return;
    }
    RsNeighbourhood where = RsNeighbourhood(uvec2(0u), 0u, 0.0, vec2(0.0), neighbours, 0u, 0.0);
    for (uint k = 0u; k <= neighbours; ++k) {
        inPreviousFrame = previous != 0u && k > 0u;
        reservoirs[k] = rsDiCandidates(surfaceOf(k), lightCount, di, random);
        reservoirs[k].confidence = surfaces[k].confidence;
        if (k == 0u || ((planted & PLANT_DROP_EMPTY) != 0u && !rsHasSample(reservoirs[k]))) continue;
        where.accepted |= 1u << (k - 1u);
        where.confidence += float(surfaces[k].confidence);
    }
    inPreviousFrame = false;
    RsSurface s = surfaceOf(0u);
    RsCombined combined =
        rsCombine(s, reservoirs[0], where, di.weights, di.visibility == RS_VISIBILITY_TRACED, random);
    RsReservoir r = combined.reservoir;
    bool occluded;
    vec3 radiance = averaged != 0u ? combined.shading.radiance : rsDiShade(s, r, di.visibility, occluded).radiance;
    results[i] = vec4(radiance, rejected == 0u ? float(rsConfidence(r)) : -1.0);
}
