#version 460
// Pure functions of one value, chosen by the first word of a record; records of 16 words in and out.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "restir/core/surface.glsl"
#include "restir/di/reservoir.glsl"

layout(local_size_x = 64) in;
struct Record { uint w[16]; };
layout(set = 0, binding = 0, scalar) readonly buffer In { Record records[]; };
layout(set = 0, binding = 1, scalar) writeonly buffer Out { Record results[]; };
layout(set = 0, binding = 2, scalar) readonly buffer Views { RsView views[]; };

uint rejected = 0u;
void rsOnRejectedWeight() { rejected++; }

vec3 asVec3(Record r, uint i) { return uintBitsToFloat(uvec3(r.w[i], r.w[i + 1], r.w[i + 2])); }
float asFloat(Record r, uint i) { return uintBitsToFloat(r.w[i]); }
void put(inout Record r, uint i, vec3 v) {
    r.w[i] = floatBitsToUint(v.x);
    r.w[i + 1] = floatBitsToUint(v.y);
    r.w[i + 2] = floatBitsToUint(v.z);
}

void packed(Record r, inout Record result) {
    vec3 v = asVec3(r, 1);
    uint normal = rsPackNormal(v), color = rsPackColor(v), radiance = rsPackRadiance(v), uv = rsPackUv(v.xy);
    put(result, 0u, rsUnpackNormal(normal));
    put(result, 3u, rsUnpackColor(color));
    put(result, 6u, rsUnpackRadiance(radiance));
    put(result, 9u, vec3(rsUnpackUv(uv), 0.0));
    result.w[12] = radiance;
    result.w[13] = rsPackRadiance(rsUnpackRadiance(radiance));
    result.w[14] = rsPackColor(rsUnpackColor(color));
    result.w[15] = rsPackUv(rsUnpackUv(uv));
}

void reservoirOf(Record r, inout Record result) {
    RsReservoir made = rsMakeReservoir(r.w[1], r.w[2], asFloat(r, 3), r.w[4], r.w[5]);
    result.w[0] = made.light;
    result.w[1] = made.uv;
    result.w[2] = floatBitsToUint(made.ucw);
    result.w[3] = rsConfidence(made);
    result.w[4] = rsAge(made);
    result.w[5] = rsHasSample(made) ? 1u : 0u;
    result.w[6] = rejected;
}

void projected(Record r, inout Record result) {
    RsView view = views[r.w[1]];
    uvec2 extent = uvec2(r.w[2], r.w[3]);
    vec3 position = asVec3(r, 4);
    vec2 pixel = rsPixelOf(view, extent, position);
    float depth = rsDepthOf(view, position);
    put(result, 0u, vec3(pixel, depth));
    put(result, 3u, rsPositionFromDepth(view, extent, pixel, depth));
    put(result, 6u, vec3(rsDepthFromDevice(view, asFloat(r, 7)), 0.0, 0.0));
    put(result, 9u, rsTowardsEye(view, position));
}

// Pixel, depth, normals, material: through the 24 bytes and back.
void surfaceOf(Record r, inout Record result) {
    RsSurface s;
    s.valid = r.w[1] != 0u;
    s.depth = asFloat(r, 2);
    s.normal = normalize(asVec3(r, 3));
    s.geometricNormal = normalize(asVec3(r, 6));
    s.baseColor = asVec3(r, 9);
    s.roughness = asFloat(r, 12);
    s.metalness = asFloat(r, 13);
    s.specular = asFloat(r, 14);
    s.materialId = r.w[15];
    RsSurface back = rsUnpackSurface(rsPackSurface(s), views[0], uvec2(640u, 400u), uvec2(100u, 50u));
    result.w[0] = back.valid ? 1u : 0u;
    result.w[1] = floatBitsToUint(back.depth);
    put(result, 2u, back.normal);
    put(result, 5u, back.geometricNormal);
    put(result, 8u, back.baseColor);
    put(result, 11u, vec3(back.roughness, back.metalness, back.specular));
    result.w[14] = back.materialId;
    result.w[15] = floatBitsToUint(distance(rsPixelOf(views[0], uvec2(640u, 400u), back.position), vec2(100.5, 50.5)));
}

void faced(Record r, inout Record result) {
    RsSurface s;
    s.normal = normalize(asVec3(r, 1));
    s.geometricNormal = normalize(asVec3(r, 4));
    s.view = normalize(asVec3(r, 7));
    rsFaceViewer(s);
    put(result, 0u, s.normal);
    put(result, 3u, s.geometricNormal);
}

// Packed with three random numbers: as radiance, and over its largest channel.
void lightOf(Record r, inout Record result) {
    vec3 v = asVec3(r, 1), u = asVec3(r, 4);
    uint rounded = rsPackRadiance(v, u);
    put(result, 0u, rsUnpackRadiance(rounded));
    put(result, 3u, rsUnpackShares(rsPackShares(v / max(v.x, max(v.y, v.z)), u)));
    result.w[6] = rounded;
}

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= records.length()) return;
    Record r = records[i], result;
    for (int k = 0; k < 16; ++k) result.w[k] = 0u;
    switch (r.w[0]) {
        case 0u: packed(r, result); break;
        case 1u: reservoirOf(r, result); break;
        case 2u: projected(r, result); break;
        case 3u: surfaceOf(r, result); break;
        case 4u: faced(r, result); break;
        case 5u: lightOf(r, result); break;
    }
    results[i] = result;
}
