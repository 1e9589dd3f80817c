// Both functions of hit.glsl, by one that traces: what the library's own backends have in common.
#ifndef RESTIR_RAYS_ANSWERS_GLSL
#define RESTIR_RAYS_ANSWERS_GLSL
#include "restir/rays/hit.glsl"

// The closest hit, or, where only `any` is asked for, t >= 0 for there being one.
RsHit rsTrace(vec3 origin, vec3 direction, float tmax, bool any, bool previous);

bool rsOccluded(vec3 origin, vec3 direction, float tmax, bool previous) {
    rsOnRay(origin, direction, tmax, false);
    return rsTrace(origin, direction, tmax, true, previous).t >= 0.0;
}

RsHit rsClosestHit(vec3 origin, vec3 direction, float tmax) {
    rsOnRay(origin, direction, tmax, true);
    return rsTrace(origin, direction, tmax, false, false);
}

#endif
