// Packed forms, each with its error bound; tests/gpu/packing_test.cpp holds them to it.
#ifndef RESTIR_CORE_PACK_GLSL
#define RESTIR_CORE_PACK_GLSL
#include "restir/core/math.glsl"

vec2 rsFoldSigns(vec2 v) { return vec2(v.x >= 0.0 ? 1.0 : -1.0, v.y >= 0.0 ? 1.0 : -1.0); }

// Octahedral map of a unit vector to [-1, 1]^2 (Cigolle et al. 2014).
vec2 rsOctahedralFromNormal(vec3 n) {
    vec2 e = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
    return n.z >= 0.0 ? e : (1.0 - abs(e.yx)) * rsFoldSigns(e);
}
vec3 rsNormalFromOctahedral(vec2 e) {
    vec3 n = vec3(e, 1.0 - abs(e.x) - abs(e.y));
    if (n.z < 0.0) n.xy = (1.0 - abs(n.yx)) * rsFoldSigns(n.xy);
    return normalize(n);
}

// 2 x 16 bits: within 0.004 degrees.
uint rsPackNormal(vec3 n) { return packSnorm2x16(rsOctahedralFromNormal(n)); }
vec3 rsUnpackNormal(uint bits) { return rsNormalFromOctahedral(unpackSnorm2x16(bits)); }

// [0, 1]^3 in 3 x 10 bits over a square root: relative error 1 % at 0.01, 0.1 % at 1.
uint rsPackColor(vec3 color) {
    uvec3 q = uvec3(sqrt(rsSaturate(color)) * 1023.0 + 0.5);
    return q.x | (q.y << 10u) | (q.z << 20u);
}
vec3 rsUnpackColor(uint bits) {
    vec3 root = vec3(uvec3(bits, bits >> 10u, bits >> 20u) & 1023u) / 1023.0;
    return root * root;
}

// [0, most]; NaN becomes 0.
vec3 rsUpTo(vec3 v, float most) {
    return vec3(v.x > 0.0 ? min(v.x, most) : 0.0, v.y > 0.0 ? min(v.y, most) : 0.0, v.z > 0.0 ? min(v.z, most) : 0.0);
}

// Non-negative radiance with a shared exponent, 9 bits a channel (as VK_FORMAT_E5B9G9R9_UFLOAT_PACK32): error at
// most 1/512 of the largest channel or 2^-25, values above 65,408 saturate.
uint rsPackRadiance(vec3 radiance) {
    vec3 c = rsUpTo(radiance, 65408.0);
    float largest = max(c.x, max(c.y, c.z));
    if (!(largest > 0.0)) return 0u;
    int exponent = int(max(floor(log2(largest)), -16.0)) + 1;
    if (uint(largest * exp2(float(9 - exponent)) + 0.5) >= 512u) exponent++;
    uvec3 q = uvec3(c * exp2(float(9 - exponent)) + 0.5);
    return q.x | (q.y << 9u) | (q.z << 18u) | (uint(exponent + 15) << 27u);
}
vec3 rsUnpackRadiance(uint bits) {
    return vec3(uvec3(bits, bits >> 9u, bits >> 18u) & 511u) * exp2(float(int(bits >> 27u) - 24));
}

// The same rounded at random, so that its mean over `u`, uniform in [0, 1)^3, is exact however small it is.
uint rsPackRadiance(vec3 radiance, vec3 u) {
    vec3 c = rsUpTo(radiance, 65280.0);
    float largest = max(c.x, max(c.y, c.z));
    if (!(largest > 0.0)) return 0u;
    int exponent = int(max(floor(log2(largest)), -16.0)) + 1;
    if (largest * exp2(float(9 - exponent)) >= 511.0) exponent++;
    uvec3 q = uvec3(c * exp2(float(9 - exponent)) + u);
    return q.x | (q.y << 9u) | (q.z << 18u) | (uint(exponent + 15) << 27u);
}

// [0, 1]^3 in 3 x 10 bits, rounded at random likewise.
uint rsPackShares(vec3 shares, vec3 u) {
    uvec3 q = min(uvec3(rsSaturate(shares) * 1023.0 + u), 1023u);
    return q.x | (q.y << 10u) | (q.z << 20u);
}
vec3 rsUnpackShares(uint bits) { return vec3(uvec3(bits, bits >> 10u, bits >> 20u) & 1023u) / 1023.0; }

// 4 x 8 bits. Unlike unpackUnorm4x8 the product is rounded correctly everywhere: 255 is 1, and no light is left in the diffuse lobe
// of a metal.
vec4 rsUnpackUnorm8(uint bits) { return vec4(uvec4(bits, bits >> 8u, bits >> 16u, bits >> 24u) & 255u) * (1.0 / 255.0); }

// [0, 1]^2 in 2 x 16 bits.
uint rsPackUv(vec2 uv) { return packUnorm2x16(uv); }
vec2 rsUnpackUv(uint bits) { return unpackUnorm2x16(bits); }

#endif
