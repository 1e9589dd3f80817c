// Rays in the scene: by ray query or, with SCENE_RAYGEN, from a ray generation shader.
#ifndef SAMPLES_SCENE_TRACE_GLSL
#define SAMPLES_SCENE_TRACE_GLSL
#include "thread.glsl"
#include "scene.glsl"
#ifdef SCENE_RAYGEN
#include "restir/rays/hit.glsl"
#else
#extension GL_EXT_ray_query : require
#endif

layout(set = 1, binding = 0) uniform accelerationStructureEXT sceneTlas;

// `flags` are gl_RayFlags*. With TerminateOnFirstHit only Hit::found means anything.
#ifdef SCENE_RAYGEN

layout(location = 0) rayPayloadEXT RsHit scenePayload;   // t is negative after a miss

Hit sceneTrace(vec3 origin, vec3 direction, float tMax, uint flags) {
    traceRayEXT(sceneTlas, flags, 0xffu, 0u, 0u, 0u, origin, 0.0, direction, tMax, 0);
    return Hit(scenePayload.t >= 0.0, scenePayload.instance, scenePayload.primitive, scenePayload.barycentrics);
}

#else

Hit sceneTrace(vec3 origin, vec3 direction, float tMax, uint flags) {
    rayQueryEXT query;
    rayQueryInitializeEXT(query, sceneTlas, flags, 0xffu, origin, 0.0, direction, tMax);
    while (rayQueryProceedEXT(query)) {
        uint record = uint(rayQueryGetIntersectionInstanceCustomIndexEXT(query, false) +
                           rayQueryGetIntersectionGeometryIndexEXT(query, false));
        uint primitive = uint(rayQueryGetIntersectionPrimitiveIndexEXT(query, false));
        if (sceneOpaque(record, primitive, rayQueryGetIntersectionBarycentricsEXT(query, false))) {
            rayQueryConfirmIntersectionEXT(query);
        }
    }
    Hit hit = Hit(false, 0u, 0u, vec2(0.0));
    if (rayQueryGetIntersectionTypeEXT(query, true) == gl_RayQueryCommittedIntersectionNoneEXT) return hit;
    hit.found = true;
    hit.record = uint(rayQueryGetIntersectionInstanceCustomIndexEXT(query, true) +
                      rayQueryGetIntersectionGeometryIndexEXT(query, true));
    hit.primitive = uint(rayQueryGetIntersectionPrimitiveIndexEXT(query, true));
    hit.barycentrics = rayQueryGetIntersectionBarycentricsEXT(query, true);
    return hit;
}

#endif
#endif
