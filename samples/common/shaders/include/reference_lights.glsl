// Light sampling of the reference: a point on one given light.
#ifndef SAMPLES_REFERENCE_LIGHTS_GLSL
#define SAMPLES_REFERENCE_LIGHTS_GLSL

// ReferenceLight in scene_lights.h.
struct ReferenceLight {
    uint kind;         // kTriangle ...
    uint record;       // of a triangle: where it is in the scene
    uint primitive;
    vec3 position;
    vec3 direction;    // of travel, unit
    vec3 intensity;
    float range;       // 0: infinite
    float coneScale;
    float coneOffset;
};
layout(set = 1, binding = 3, scalar) readonly buffer ReferenceLights { ReferenceLight referenceLights[]; };

const uint kTriangle = 0u;
const uint kDirectional = 2u;   // 1: point and spot
const float kFarAway = 1e6;     // where shadow rays to directional lights end

struct LightSample {
    vec3 direction;   // unit, towards the light
    vec3 target;      // end of the shadow ray
    vec3 radiance;    // area light: radiance; else irradiance on a facing plane
    float pdf;        // solid angle, given the light; 0: a direction that only this light knows
    float weight;     // 1 / pdf, 1 for delta lights, 0: no light arrives
};

// Density of uniform points on a triangle as seen from `from`, solid angle.
float trianglePdf(Surface s, vec3 from) {
    vec3 doubleArea = cross(s.edge1, s.edge2);
    vec3 d = s.position - from;
    float projected = 0.5 * abs(dot(doubleArea, d));   // area x cosine x distance
    float distanceSquared = dot(d, d);
    return projected > 0.0 ? distanceSquared * sqrt(distanceSquared) / projected : 0.0;
}

LightSample sampleTriangle(ReferenceLight light, vec2 random, vec3 from) {
    // Folding the unit square; the barycentrics are those of vertices 1 and 2, as in a hit.
    vec2 b = random.x + random.y > 1.0 ? 1.0 - random : random;
    Surface s = sceneSurface(Hit(true, light.record, light.primitive, b));
    vec3 size = abs(s.position);
    vec3 d = s.position - from;
    float lift = 4e-5 * max(max(size.x, size.y), max(size.z, length(d)));
    LightSample result;
    result.direction = normalize(d);
    // The ray ends just in front of the emitter, on the side it is seen from.
    result.target = s.position - lift * s.geometricNormal * sign(dot(s.geometricNormal, d));
    result.pdf = trianglePdf(s, from);
    bool present = sceneOpaque(light.record, light.primitive, b);
    result.radiance = present ? sceneEmission(s, -result.direction) : vec3(0.0);
    result.weight = result.pdf > 0.0 ? 1.0 / result.pdf : 0.0;
    return result;
}

// KHR_lights_punctual.
LightSample samplePunctual(ReferenceLight light, vec3 from) {
    LightSample result;
    result.pdf = 0.0;
    result.weight = 1.0;
    if (light.kind == kDirectional) {
        result.direction = -light.direction;
        result.target = from + kFarAway * result.direction;
        result.radiance = light.intensity;
        return result;
    }
    vec3 d = light.position - from;
    float distanceSquared = dot(d, d);
    result.direction = d * inversesqrt(distanceSquared);
    result.target = light.position;
    float window = 1.0;
    if (light.range > 0.0) {
        float ratio = distanceSquared / (light.range * light.range);
        window = clamp(1.0 - ratio * ratio, 0.0, 1.0);
    }
    float cosine = -dot(light.direction, result.direction);
    float cone = clamp(cosine * light.coneScale + light.coneOffset, 0.0, 1.0);
    result.radiance = light.intensity * window * cone * cone / distanceSquared;
    return result;
}

LightSample sampleLight(uint index, vec2 random, vec3 from) {
    ReferenceLight light = referenceLights[index];
    if (light.kind == kTriangle) return sampleTriangle(light, random, from);
    return samplePunctual(light, from);
}

#endif
