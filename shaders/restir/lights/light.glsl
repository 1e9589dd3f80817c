// One light: its points, and what arrives from them.
//
// Measure. A point on a light is (id, u, v) with (u, v) barycentric on a triangle and (0, 0) on a punctual light. All
// densities, targets and weights of ReSTIR DI are per unit of that parameter domain scaled to total 1: a uniform
// point on light i drawn with probability P_i has density P_i. The integrand carries dA = area per unit. This is the
// area measure up to a factor per light, and it is the reason why a light that moves or changes size keeps its samples
// with |J| = 1 (the dA_now / dA_then of the area measure sits in the two targets).
#ifndef RESTIR_LIGHTS_LIGHT_GLSL
#define RESTIR_LIGHTS_LIGHT_GLSL
#include "restir/core/math.glsl"
#include "restir/core/pack.glsl"
#include "restir/shared/lights.h"

vec4 rsBridgeTexture(uint index, vec2 uv);

struct RsIncident {
    vec3 direction;     // unit, from the receiver to the light
    float distance;     // metres; RS_FAR for directional lights
    vec3 irradiance;    // per unit of the light's domain, on a plane facing the light, W / m^2
    float solidAngle;   // d omega per unit of the domain; 0 for lights without extent
};

bool rsIsTextured(uint kindAndTexture) { return kindAndTexture >> RS_LIGHT_TEXTURE_SHIFT != RS_LIGHT_NO_TEXTURE; }
uint rsLightKind(RsPackedLight light) { return light.kindAndTexture & RS_LIGHT_KIND_MASK; }

// Uniform on the triangle: the unit square folded over its diagonal, quantised as it will be stored.
uint rsSampleLightUv(RsPackedLight light, uint bits) {
    if (rsLightKind(light) != RS_LIGHT_TRIANGLE) return 0u;
    uint u = bits & 0xffffu, v = bits >> 16u;
    return u + v > 0xffffu ? (0xffffu - u) | ((0xffffu - v) << 16u) : bits;
}

vec3 rsTriangleRadiance(RsPackedLight light, vec2 uv) {
    if (!rsIsTextured(light.kindAndTexture)) return light.emission;
    uint index = light.kindAndTexture >> RS_LIGHT_TEXTURE_SHIFT;
    vec2 coordinates = light.uv0 + uv.x * (light.uv1 - light.uv0) + uv.y * (light.uv2 - light.uv0);
    return light.emission * rsBridgeTexture(index, coordinates).rgb;
}

// glTF KHR_lights_punctual: inverse square, windowed to reach 0 at the range.
float rsRangeFalloff(float distanceSquared, float range) {
    float window = 1.0;
    if (range > 0.0) {
        float q = distanceSquared / (range * range);
        window = clamp(1.0 - q * q, 0.0, 1.0);
    }
    return window / distanceSquared;
}

RsIncident rsIncident(RsPackedLight light, uint packedUv, vec3 receiver) {
    RsIncident none = RsIncident(vec3(0.0, 0.0, 1.0), 0.0, vec3(0.0), 0.0);
    uint kind = rsLightKind(light);
    if (kind == RS_LIGHT_NONE) return none;
    if (kind == RS_LIGHT_DIRECTIONAL) return RsIncident(-light.edge1, RS_FAR, light.emission, 0.0);

    vec2 uv = rsUnpackUv(packedUv);
    bool triangle = kind == RS_LIGHT_TRIANGLE;
    vec3 toLight = light.position - receiver;
    if (triangle) toLight += uv.x * light.edge1 + uv.y * light.edge2;
    float distanceSquared = dot(toLight, toLight);
    if (!(distanceSquared > 1e-20)) return none;
    float distance = sqrt(distanceSquared);
    vec3 direction = toLight / distance;

    if (triangle) {
        vec3 areaNormal = 0.5 * cross(light.edge1, light.edge2);   // length: area
        float cosArea = -dot(areaNormal, direction);
        if ((light.kindAndTexture & RS_LIGHT_TWO_SIDED) != 0u) cosArea = abs(cosArea);
        if (!(cosArea > 0.0)) return none;
        float solidAngle = cosArea / distanceSquared;
        return RsIncident(direction, distance, rsTriangleRadiance(light, uv) * solidAngle, solidAngle);
    }
    float falloff = rsRangeFalloff(distanceSquared, light.edge2.z);
    if (kind == RS_LIGHT_SPOT) {
        float cone = clamp(-dot(light.edge1, direction) * light.edge2.x + light.edge2.y, 0.0, 1.0);
        falloff *= cone * cone;
    }
    return RsIncident(direction, distance, light.emission * falloff, 0.0);
}

#endif
