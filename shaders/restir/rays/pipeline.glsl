// Ray backend: VK_KHR_ray_tracing_pipeline. The includer declares `accelerationStructureEXT rsTlas` and `rsPreviousTlas`, last
// frame's, and is a ray generation shader; hit group 0 and miss shader 0 are those of rays/pipeline.
#ifndef RESTIR_RAYS_PIPELINE_GLSL
#define RESTIR_RAYS_PIPELINE_GLSL
#include "restir/rays/hit.glsl"

layout(location = 0) rayPayloadEXT RsHit rsPayload;

// A ray that ends at any hit runs no closest-hit shader: what it finds is what rsPayload was before, and no miss.
RsHit rsTracePipeline(vec3 origin, vec3 direction, float tmax, uint flags, bool previous) {
    rsPayload = RsHit(0.0, 0u, 0u, vec2(0.0));
    if (previous)
        traceRayEXT(rsPreviousTlas, flags, 0xffu, 0u, 0u, 0u, origin, 0.0, direction, tmax, 0);
    else
        traceRayEXT(rsTlas, flags, 0xffu, 0u, 0u, 0u, origin, 0.0, direction, tmax, 0);
    return rsPayload;
}

bool rsOccluded(vec3 origin, vec3 direction, float tmax, bool previous) {
    rsOnRay(origin, direction, tmax, false);
    uint flags = gl_RayFlagsTerminateOnFirstHitEXT | gl_RayFlagsSkipClosestHitShaderEXT;
    return rsTracePipeline(origin, direction, tmax, flags, previous).t >= 0.0;
}

RsHit rsClosestHit(vec3 origin, vec3 direction, float tmax) {
    rsOnRay(origin, direction, tmax, true);
    return rsTracePipeline(origin, direction, tmax, gl_RayFlagsNoneEXT, false);
}

#endif
