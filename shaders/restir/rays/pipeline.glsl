// Ray backend: VK_KHR_ray_tracing_pipeline. The includer declares `accelerationStructureEXT rsTlas` and `rsPreviousTlas`, last
// frame's, and is a ray generation shader; hit group 0 and miss shader 0 are those of rays/pipeline.
#ifndef RESTIR_RAYS_PIPELINE_GLSL
#define RESTIR_RAYS_PIPELINE_GLSL
#include "restir/rays/answers.glsl"

layout(location = 0) rayPayloadEXT RsHit rsPayload;

// A ray that ends at any hit runs no closest-hit shader: what it finds is what rsPayload was before, and no miss.
RsHit rsTrace(vec3 origin, vec3 direction, float tmax, bool any, bool previous) {
    uint flags = any ? gl_RayFlagsTerminateOnFirstHitEXT | gl_RayFlagsSkipClosestHitShaderEXT : gl_RayFlagsNoneEXT;
    rsPayload = RsHit(0.0, 0u, 0u, vec2(0.0));
    if (previous)
        traceRayEXT(rsPreviousTlas, flags, 0xffu, 0u, 0u, 0u, origin, 0.0, direction, tmax, 0);
    else
        traceRayEXT(rsTlas, flags, 0xffu, 0u, 0u, 0u, origin, 0.0, direction, tmax, 0);
    return rsPayload;
}

#endif
