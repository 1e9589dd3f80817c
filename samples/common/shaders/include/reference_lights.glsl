// Light sampling of the reference: a point on one given light, uniform over its area where it has one.
#ifndef SAMPLES_REFERENCE_LIGHTS_GLSL
#define SAMPLES_REFERENCE_LIGHTS_GLSL
#include "sky.glsl"

// ReferenceLight in scene_lights.h.
struct ReferenceLight {
    uint kind;         // kTriangle ...
    uint record;       // of a triangle: where it is in the scene
    uint primitive;
    vec3 position;     // capsule: one end of its axis; rectangle: a corner
    vec3 direction;    // of travel, unit; disk: its front; capsule: to the other end, as long as it is
    vec3 intensity;
    float range;       // 0: infinite
    float coneScale;
    float coneOffset;
    float radius;      // sun: half its angle, radians
    vec3 edge1;        // rectangle
    vec3 edge2;
    uint twoSided;
    uint profile;      // texture of a point or spot light, edge1 and edge2 its x and z axes
};
layout(set = 1, binding = 3, scalar) readonly buffer ReferenceLights { ReferenceLight referenceLights[]; };

const uint kTriangle = 0u;
const uint kDirectional = 2u;   // 1: point and spot
const uint kCapsule = 3u;       // a sphere is one without length
const uint kRectangle = 4u;
const uint kDisk = 5u;
const uint kSky = 6u;
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

// KHR_lights_punctual; and suns.
LightSample samplePunctual(ReferenceLight light, vec2 random, vec3 from) {
    LightSample result;
    result.pdf = 0.0;
    result.weight = 1.0;
    if (light.kind == kDirectional) {
        result.direction = -light.direction;
        result.radiance = light.intensity;
        if (light.radius > 0.0) {   // uniform in the cone; 1 - cos by half angles
            float s = sin(0.5 * light.radius), less = 2.0 * s * s * random.x, phi = 2.0 * kSkyPi * random.y;
            vec3 side = normalize(abs(light.direction.y) < 0.9 ? cross(light.direction, vec3(0.0, 1.0, 0.0))
                                                               : cross(light.direction, vec3(1.0, 0.0, 0.0)));
            vec3 other = cross(light.direction, side);
            result.direction = normalize((1.0 - less) * result.direction +
                                         sqrt(less * (2.0 - less)) * (cos(phi) * side + sin(phi) * other));
            // Radiance x solid angle = E / (pi sin^2) x 4 pi s^2
            result.radiance *= 4.0 * s * s / (sin(light.radius) * sin(light.radius));
        }
        result.target = from + kFarAway * result.direction;
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
    if (light.profile != RS_NO_TEXTURE) {
        vec3 travel = -result.direction, y = cross(light.edge2, light.edge1);
        float vertical = acos(clamp(-dot(travel, light.edge2), -1.0, 1.0));
        float horizontal = atan(dot(travel, y), dot(travel, light.edge1));
        result.radiance *= sceneTexture(light.profile, vec2(horizontal / (2.0 * kSkyPi), vertical / kSkyPi)).rgb;
    }
    return result;
}

// A point of a capsule, round ends and tube by their areas; `normal` outwards.
vec3 capsulePoint(ReferenceLight light, vec2 random, out vec3 normal) {
    float span = length(light.direction), phi = 2.0 * kSkyPi * random.y;
    vec3 axis = span > 0.0 ? light.direction / span : vec3(0.0, 1.0, 0.0);
    vec3 x = normalize(abs(axis.x) < 0.6 ? cross(axis, vec3(1.0, 0.0, 0.0)) : cross(axis, vec3(0.0, 0.0, 1.0)));
    vec3 y = cross(axis, x);
    float at = random.x * (span + 2.0 * light.radius), z = 0.0;
    if (at > span) {
        z = 1.0 - (at - span) / light.radius;   // an end's height on its sphere
        at = z > 0.0 ? span : 0.0;
    }
    normal = z * axis + sqrt(max(1.0 - z * z, 0.0)) * (cos(phi) * x + sin(phi) * y);
    return light.position + at * axis + light.radius * normal;
}

LightSample sampleShape(ReferenceLight light, vec2 random, vec3 from) {
    LightSample result;
    vec3 normal = light.direction;
    float area;
    if (light.kind == kCapsule) {
        result.target = capsulePoint(light, random, normal);
        area = 2.0 * kSkyPi * light.radius * (length(light.direction) + 2.0 * light.radius);
    } else if (light.kind == kDisk) {
        vec3 x = normalize(abs(normal.x) < 0.6 ? cross(normal, vec3(1.0, 0.0, 0.0)) : cross(normal, vec3(0.0, 0.0, 1.0)));
        float r = light.radius * sqrt(random.x), phi = 2.0 * kSkyPi * random.y;
        result.target = light.position + r * (cos(phi) * x + sin(phi) * cross(normal, x));
        area = kSkyPi * light.radius * light.radius;
    } else {
        normal = cross(light.edge1, light.edge2);
        area = length(normal);
        normal = area > 0.0 ? normal / area : vec3(0.0);
        result.target = light.position + random.x * light.edge1 + random.y * light.edge2;
    }
    vec3 d = result.target - from;
    float distanceSquared = max(dot(d, d), 1e-30);
    result.direction = d * inversesqrt(distanceSquared);
    float cosine = -dot(normal, result.direction);
    if (light.twoSided != 0u) cosine = abs(cosine);
    result.radiance = light.intensity;
    result.pdf = 0.0;
    result.weight = max(cosine, 0.0) * area / distanceSquared;
    return result;
}

LightSample sampleLight(uint index, vec3 random, vec3 from) {
    ReferenceLight light = referenceLights[index];
    if (light.kind == kTriangle) return sampleTriangle(light, random.xy, from);
    if (light.kind == kSky) {
        vec3 direction = sampleSky(random);
        float pdf = skyPdf(direction);
        return LightSample(direction, from + kFarAway * direction, skyRadiance(direction), pdf, 1.0 / pdf);
    }
    if (light.kind >= kCapsule) return sampleShape(light, random.xy, from);
    return samplePunctual(light, random.xy, from);
}

#endif
