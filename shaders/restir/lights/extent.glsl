// The box around the lights that are somewhere, by integer maxima, which have no order.
#ifndef RESTIR_LIGHTS_EXTENT_GLSL
#define RESTIR_LIGHTS_EXTENT_GLSL
#include "restir/lights/power.glsl"

// Grows with `value`; 0 is below all finite values. The upper end of a range is a maximum of these, the lower one of
// those of the negative values.
uint rsOrdered(float value) {
    uint bits = floatBitsToUint(value);
    return (bits & 0x80000000u) != 0u ? ~bits : bits | 0x80000000u;
}
float rsFromOrdered(uint key) { return uintBitsToFloat((key & 0x80000000u) != 0u ? key & 0x7fffffffu : ~key); }

// A light of this kind is somewhere.
bool rsIsFinite(uint kind) { return kind != RS_LIGHT_NONE && kind != RS_LIGHT_DIRECTIONAL && kind != RS_LIGHT_ENVIRONMENT; }

// Area of a disc that holds the box, at least that of the unit disc: what a light at infinity shines on. `high` and
// `low` are the maxima of rsOrdered(x) and rsOrdered(-x), 0 if there is no light.
RsScaled rsSceneArea(uvec3 high, uvec3 low) {
    RsScaled least = rsScaled(RS_PI);
    if (high.x == 0u) return least;
    vec3 halfDiagonal;
    for (int i = 0; i < 3; ++i) halfDiagonal[i] = 0.5 * rsFromOrdered(high[i]) + 0.5 * rsFromOrdered(low[i]);
    int shift;
    vec3 d = rsNormalized(halfDiagonal, shift);
    RsScaled area = rsScaled(RS_PI * dot(d, d));
    area.exponent += 2 * shift;
    bool less = area.mantissa == 0.0 || area.exponent < least.exponent ||
                (area.exponent == least.exponent && area.mantissa < least.mantissa);
    return less ? least : area;
}

#endif
