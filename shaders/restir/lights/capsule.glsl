// Capsules: all points at one distance from a segment. A sphere is a capsule of length 0. u runs from tip to tip, equal
// steps holding equal areas (Archimedes: a round end has the area of a tube as long as its radius): first the points of one
// round end, each a disc of equal area, so that cells are nowhere long and thin; then the tube, v around it; then the
// other end. Seen from outside, what faces a point of a capsule is visible from there. Receivers inside see nothing.
#ifndef RESTIR_LIGHTS_CAPSULE_GLSL
#define RESTIR_LIGHTS_CAPSULE_GLSL
#include "restir/lights/cells.glsl"
#include "restir/shared/lights.h"

struct RsLightPoint {
    vec3 offset;       // from RsPackedLight::position
    vec3 areaNormal;   // outwards, as long as the whole light's area
};

vec3 rsCapsuleAxis(RsPackedLight light) {
    float squared = dot(light.edge1, light.edge1);
    return squared > 0.0 ? light.edge1 * inversesqrt(squared) : vec3(0.0, 0.0, 1.0);
}

// Lambert's azimuthal projection of the upper hemisphere on the unit disc, equal in area.
vec3 rsHemisphereFromDisc(vec2 p) { return vec3(p * sqrt(2.0 - dot(p, p)), 1.0 - dot(p, p)); }
vec2 rsDiscFromHemisphere(vec3 n) { return n.xy * inversesqrt(1.0 + n.z); }

RsLightPoint rsCapsulePoint(RsPackedLight light, vec2 uv) {
    float radius = light.edge2.x, span = length(light.edge1), all = span + 2.0 * radius;
    float along = uv.x * all, onAxis = clamp(along - radius, 0.0, span), phi = 2.0 * RS_PI * uv.y;
    vec3 normal = vec3(cos(phi), sin(phi), 0.0);
    bool first = along < radius;
    if (first || along > radius + span) {
        float u = first ? along / radius : (along - radius - span) / radius;
        normal = rsHemisphereFromDisc(rsDiscFromSquare(vec2(min(u, 1.0), uv.y)));
        if (first) normal.z = -normal.z;
    }
    vec3 axis = rsCapsuleAxis(light);
    normal = rsBasis(axis) * normal;
    return RsLightPoint(onAxis * axis + radius * normal, 2.0 * RS_PI * radius * all * normal);
}

// 1 - cos of the angle under which half of a sphere is seen; 0 for other capsules and from inside.
float rsSphereCone(RsPackedLight light, vec3 receiver) {
    vec3 toCentre = light.position - receiver;
    float sine2 = light.edge2.x * light.edge2.x / dot(toCentre, toCentre);
    bool outside = light.edge1 == vec3(0.0) && sine2 < 1.0;
    return outside ? sine2 / (1.0 + sqrt(1.0 - sine2)) : 0.0;
}

// A point of a sphere whose direction from the receiver is uniform in the cone; `cone` as above, > 0.
vec2 rsSampleSphereUv(RsPackedLight light, vec3 receiver, float cone, vec2 random) {
    float lessCosine = random.x * cone, cosine = 1.0 - lessCosine;
    float sine = sqrt(lessCosine * (2.0 - lessCosine)), largest = sqrt(cone * (2.0 - cone));
    // Angles at the sphere: of the ray to the normal, then of the normal to the receiver.
    float sineNormal = min(sine / largest, 1.0), cosineNormal = sqrt(1.0 - sineNormal * sineNormal);
    float sineCentre = sineNormal * cosine - cosineNormal * sine;
    float cosineCentre = cosineNormal * cosine + sineNormal * sine;
    float phi = 2.0 * RS_PI * random.y;
    vec3 normal = rsBasis(normalize(receiver - light.position)) *
                  vec3(sineCentre * cos(phi), sineCentre * sin(phi), cosineCentre);
    vec3 local = normal * rsBasis(rsCapsuleAxis(light));
    vec2 uv = rsSquareFromDisc(rsDiscFromHemisphere(vec3(local.xy, abs(local.z))));
    return vec2(0.5 * uv.x + (local.z < 0.0 ? 0.0 : 0.5), uv.y);
}

#endif
