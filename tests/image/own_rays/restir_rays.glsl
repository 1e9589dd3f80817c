// A host's own way to trace: one wall, by formula. tests/image/own_rays_test.cpp has it as triangles, too.
#include "restir/rays/hit.glsl"

RsHit wallHit(vec3 origin, vec3 direction, float tmax) {
    float t = (0.5 - origin.y) / direction.y;
    bool hit = t > 0.0 && t < tmax && origin.x + t * direction.x > 0.1;
    return hit ? RsHit(t, 1u, 0u, vec2(0.25)) : RsHit(-1.0, 0u, 0u, vec2(0.0));
}

bool rsOccluded(vec3 origin, vec3 direction, float tmax, bool previous) {
    rsOnRay(origin, direction, tmax, false);
    return wallHit(origin, direction, tmax).t >= 0.0;
}

RsHit rsClosestHit(vec3 origin, vec3 direction, float tmax) {
    rsOnRay(origin, direction, tmax, true);
    return wallHit(origin, direction, tmax);
}
