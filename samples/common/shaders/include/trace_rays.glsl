// Traces a list of rays and says what they hit. The includer includes a ray backend behind this file.
#include "restir/rays/hit.glsl"
#include "restir/shared/frame.h"
#include "common/shaders/include/scene.glsl"
#include "common/shaders/include/thread.glsl"

layout(set = 0, binding = 0, scalar) readonly buffer Rays { RsLoggedRay rays[]; };
layout(set = 0, binding = 1, scalar) writeonly buffer Hits { RsHit hits[]; };   // t of any hit: 1 or -1

void rsOnRay(vec3 origin, vec3 direction, float tmax, bool closest) {}
bool rsBridgeOpaque(RsHit hit) { return sceneOpaque(hit.instance, hit.primitive, hit.barycentrics); }

void traceRay(uint i, bool previous) {
    RsLoggedRay ray = rays[i];
    RsHit hit = RsHit(-1.0, 0u, 0u, vec2(0.0));
    if (ray.directionClosest.w > 0.5) hit = rsClosestHit(ray.originTmax.xyz, ray.directionClosest.xyz, ray.originTmax.w);
    else if (rsOccluded(ray.originTmax.xyz, ray.directionClosest.xyz, ray.originTmax.w, previous)) hit.t = 1.0;
    hits[i] = hit;
}
