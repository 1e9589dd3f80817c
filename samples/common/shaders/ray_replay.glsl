// Traces a ray log again and does nothing else: what the rays of a frame cost by themselves.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "restir/shared/frame.h"
#include "common/shaders/include/scene.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0, scalar) buffer RayLog { RsLoggedRay rays[]; };
layout(push_constant) uniform Push { uint rayCount; };

void main() {
    uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    uint i = group * 64u + gl_LocalInvocationIndex;
    if (i >= rayCount) return;
    RsLoggedRay ray = rays[i];
    uint flags = ray.directionClosest.w > 0.5 ? gl_RayFlagsNoneEXT : gl_RayFlagsTerminateOnFirstHitEXT;
    rayQueryEXT query;
    rayQueryInitializeEXT(query, sceneTlas, flags, 0xffu, ray.originTmax.xyz, 0.0, ray.directionClosest.xyz, ray.originTmax.w);
    while (rayQueryProceedEXT(query)) rayQueryConfirmIntersectionEXT(query);
    float t = rayQueryGetIntersectionTypeEXT(query, true) == gl_RayQueryCommittedIntersectionNoneEXT
                  ? 0.0
                  : rayQueryGetIntersectionTEXT(query, true);
    if (t < 0.0) rays[i].originTmax.w = t;   // never; keeps the trace alive
}
