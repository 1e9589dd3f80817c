// Ray backend: VK_KHR_ray_query. The includer declares `accelerationStructureEXT rsTlas` and
// `rsPreviousTlas`, last frame's. Only the start of a traversal names one: the traversal is there once.
#ifndef RESTIR_RAYS_QUERY_GLSL
#define RESTIR_RAYS_QUERY_GLSL
#include "restir/rays/answers.glsl"

RsHit rsTrace(vec3 origin, vec3 direction, float tmax, bool any, bool previous) {
    uint flags = any ? gl_RayFlagsTerminateOnFirstHitEXT : gl_RayFlagsNoneEXT;
    rayQueryEXT query;
    if (previous)
        rayQueryInitializeEXT(query, rsPreviousTlas, flags, 0xffu, origin, 0.0, direction, tmax);
    else
        rayQueryInitializeEXT(query, rsTlas, flags, 0xffu, origin, 0.0, direction, tmax);
    while (rayQueryProceedEXT(query)) {
        if (rayQueryGetIntersectionTypeEXT(query, false) != gl_RayQueryCandidateIntersectionTriangleEXT) continue;
        uint record = uint(rayQueryGetIntersectionInstanceCustomIndexEXT(query, false) +
                           rayQueryGetIntersectionGeometryIndexEXT(query, false));
        RsHit candidate = RsHit(rayQueryGetIntersectionTEXT(query, false), record,
                                uint(rayQueryGetIntersectionPrimitiveIndexEXT(query, false)),
                                rayQueryGetIntersectionBarycentricsEXT(query, false));
        if (rsBridgeOpaque(candidate)) rayQueryConfirmIntersectionEXT(query);
    }
    if (rayQueryGetIntersectionTypeEXT(query, true) == gl_RayQueryCommittedIntersectionNoneEXT)
        return RsHit(-1.0, 0u, 0u, vec2(0.0));
    return RsHit(rayQueryGetIntersectionTEXT(query, true),
                 uint(rayQueryGetIntersectionInstanceCustomIndexEXT(query, true) +
                      rayQueryGetIntersectionGeometryIndexEXT(query, true)),
                 uint(rayQueryGetIntersectionPrimitiveIndexEXT(query, true)),
                 rayQueryGetIntersectionBarycentricsEXT(query, true));
}

#endif
