// Traces a list of rays and says what they hit. The includer declares its push constants, with rayCount, and includes a ray
// backend behind this file. TRACE_BY_ADDRESS: a ray generation shader, whose push constants are here.
#include "restir/rays/hit.glsl"
#include "restir/shared/frame.h"
#include "common/shaders/include/scene.glsl"

// t of any hit: 1 or -1
#ifdef TRACE_BY_ADDRESS
layout(buffer_reference, scalar) readonly buffer Rays { RsLoggedRay at[]; };
layout(buffer_reference, scalar) writeonly buffer Hits { RsHit at[]; };
layout(push_constant, scalar) uniform Push { Rays rayList; Hits hitList; uint rayCount; };
#define rays rayList.at
#define hits hitList.at
#else
layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0, scalar) readonly buffer Rays { RsLoggedRay rays[]; };
layout(set = 0, binding = 1, scalar) writeonly buffer Hits { RsHit hits[]; };
uint rayOfInvocation() { return (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * 64u + gl_LocalInvocationIndex; }
#endif

void rsOnRay(vec3 origin, vec3 direction, float tmax, bool closest) {}
bool rsBridgeOpaque(RsHit hit) { return sceneOpaque(hit.instance, hit.primitive, hit.barycentrics); }

void traceRay(uint i, bool previous) {
    RsLoggedRay ray = rays[i];
    RsHit hit = RsHit(-1.0, 0u, 0u, vec2(0.0));
    if (ray.directionClosest.w > 0.5) hit = rsClosestHit(ray.originTmax.xyz, ray.directionClosest.xyz, ray.originTmax.w);
    else if (rsOccluded(ray.originTmax.xyz, ray.directionClosest.xyz, ray.originTmax.w, previous)) hit.t = 1.0;
    hits[i] = hit;
}
