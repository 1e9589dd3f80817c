// Traces a ray log again and does nothing else: what the rays of a frame cost by themselves.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "restir/shared/frame.h"
#include "common/shaders/include/scene_trace.glsl"

layout(set = 0, binding = 0, scalar) buffer RayLog { RsLoggedRay rays[]; };
layout(push_constant) uniform Push { uint rayCount; };

void main() {
    uint i = sceneThreadIndex();
    if (i >= rayCount) return;
    RsLoggedRay ray = rays[i];
    uint flags = ray.directionClosest.w > 0.5 ? gl_RayFlagsNoneEXT : gl_RayFlagsTerminateOnFirstHitEXT;
    Hit hit = sceneTrace(ray.originTmax.xyz, ray.directionClosest.xyz, ray.originTmax.w, flags | gl_RayFlagsOpaqueEXT);
    if (hit.barycentrics.x < 0.0) rays[i].originTmax.w = 0.0;   // never; keeps the trace alive
}
