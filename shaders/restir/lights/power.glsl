// Radiant power by luminance, by which lights are drawn.
//
// Areas and emissions whose products leave the range of floats are lights, too: powers are a mantissa and an exponent.
#ifndef RESTIR_LIGHTS_POWER_GLSL
#define RESTIR_LIGHTS_POWER_GLSL
#include "restir/core/math.glsl"
#include "restir/shared/lights.h"

// mantissa 2^exponent, with mantissa in [1, 2) or 0.
struct RsScaled {
    float mantissa;
    int exponent;
};

// Of value >= 0; subnormal numbers are 0.
RsScaled rsScaled(float value) {
    uint bits = floatBitsToUint(value);
    uint exponent = bits >> 23u;
    return exponent == 0u ? RsScaled(0.0, 0)
                          : RsScaled(uintBitsToFloat((bits & 0x7fffffu) | 0x3f800000u), int(exponent) - 127);
}
RsScaled rsTimes(RsScaled a, RsScaled b) {
    RsScaled product = rsScaled(a.mantissa * b.mantissa);
    return RsScaled(product.mantissa, product.exponent + a.exponent + b.exponent);
}

// v / 2^shift, its largest component in [1, 2); 0 stays 0.
vec3 rsNormalized(vec3 v, out int shift) {
    RsScaled largest = rsScaled(max(max(abs(v.x), abs(v.y)), abs(v.z)));
    shift = largest.exponent;
    if (largest.mantissa == 0.0) return vec3(0.0);
    // In two steps: 2^-shift alone may be no normal number.
    int first = shift / 2;
    return v * uintBitsToFloat(uint(127 - first) << 23u) * uintBitsToFloat(uint(127 - (shift - first)) << 23u);
}

RsScaled rsTriangleArea(vec3 edge1, vec3 edge2) {
    int shift1, shift2;
    vec3 a = rsNormalized(edge1, shift1), b = rsNormalized(edge2, shift2);
    RsScaled area = rsScaled(0.5 * length(cross(a, b)));
    return RsScaled(area.mantissa, area.exponent + shift1 + shift2);
}

RsScaled rsLength(vec3 v) {
    int shift;
    RsScaled size = rsScaled(length(rsNormalized(v, shift)));
    return RsScaled(size.mantissa, size.mantissa > 0.0 ? size.exponent + shift : 0);
}

// Of a capsule: a tube and its round ends, each end as much as a tube of its radius.
RsScaled rsCapsuleArea(vec3 axis, float radius) {
    RsScaled r = rsScaled(radius), span = rsLength(axis);
    if (r.mantissa == 0.0) return r;
    // Relative to the radius; beyond 2^100 of it the ends are nothing.
    float ends = 2.0, tube = span.mantissa * exp2(float(clamp(span.exponent - r.exponent, -100, 100))) / r.mantissa;
    return rsTimes(rsTimes(r, r), rsScaled(2.0 * RS_PI * (ends + tube)));
}

// Integral of a spot's cone over directions, as rsIncident has it: clamp(cos scale + offset, 0, 1)^2.
float rsConeSolidAngle(float scale, float offset) {
    float axis = min(scale + offset, 1.0);
    return 2.0 * RS_PI * (max(1.0 - (1.0 - offset) / scale, 0.0) + axis * axis * axis / (3.0 * scale));
}

// `light.selection` holds the mean luminance of its emission, the environment's times its map's integral over
// the sphere; `sceneArea` (m^2) is what a light at infinity shines on.
RsScaled rsLightPower(RsPackedLight light, RsScaled sceneArea) {
    RsScaled shine = rsScaled(light.selection);
    float sides = RS_PI * ((light.kindAndTexture & RS_LIGHT_TWO_SIDED) != 0u ? 2.0 : 1.0);   // of what is flat
    switch (light.kindAndTexture & RS_LIGHT_KIND_MASK) {
        case RS_LIGHT_TRIANGLE: return rsTimes(rsTimes(shine, rsScaled(sides)), rsTriangleArea(light.edge1, light.edge2));
        case RS_LIGHT_RECTANGLE: return rsTimes(rsTimes(shine, rsScaled(2.0 * sides)), rsTriangleArea(light.edge1, light.edge2));
        case RS_LIGHT_DISK: return rsTimes(rsTimes(shine, rsScaled(2.0 * RS_PI * sides)), rsTriangleArea(light.edge1, light.edge2));
        case RS_LIGHT_CAPSULE: return rsTimes(rsTimes(shine, rsScaled(RS_PI)), rsCapsuleArea(light.edge1, light.edge2.x));
        case RS_LIGHT_POINT: return rsTimes(shine, rsScaled(4.0 * RS_PI));
        case RS_LIGHT_SPOT: return rsTimes(shine, rsScaled(rsConeSolidAngle(light.edge2.x, light.edge2.y)));
        case RS_LIGHT_DIRECTIONAL:
        case RS_LIGHT_ENVIRONMENT: return rsTimes(shine, sceneArea);
    }
    return RsScaled(0.0, 0);
}

// Ten bits of exponent, then 22 of mantissa: grows with the power, 0 for none.
uint rsPowerCode(RsScaled power) {
    if (!(power.mantissa > 0.0)) return 0u;
    uint exponent = uint(clamp(power.exponent + 512, 1, 1023));
    return exponent << 22u | (floatBitsToUint(power.mantissa) >> 1u & 0x3fffffu);
}

#endif
