// Where things move, a path that was found in one frame may not have been found in the other: targets of both frames must be of what
// each can sample (section 4), so x2 must be on a surface of that frame, and a light's point be seen from it.
#ifndef RESTIR_GI_STANDS_GLSL
#define RESTIR_GI_STANDS_GLSL
#include "restir/gi/reservoir.glsl"

// x: whether this frame's sample stands in the last frame, y: whether the last frame's does in this one. A loop around one call: four
// traversals would be four times the code.
bvec2 rsStandBetween(RsGiReservoir fresh, RsGiReservoir history) {
    bvec2 stands = bvec2(true);
    for (uint i = 0u; i < 4u; ++i) {
        bool previous = i < 2u, onSurface = (i & 1u) == 0u;
        RsGiReservoir r = history;
        if (previous) r = fresh;
        bool lit = (r.surface.z & RS_GI_FOLLOWED) == 0u;
        if (!rsHasSample(r) || !(previous ? stands.x : stands.y) || !(onSurface || lit)) continue;
        vec3 normal = rsUnpackNormal(r.geometricNormal), size = abs(r.position);
        float offset = RS_ORIGIN_OFFSET * max(size.x, max(size.y, size.z));
        vec3 origin = r.position + offset * normal, direction = -normal;
        float reach = 2.0 * offset;
        if (!onSurface) {
            RsPackedLight light = previous ? rsLoadPreviousLight(r.arrival.x) : rsLoadLight(r.arrival.x);
            RsIncident arriving = rsIncident(light, r.arrival.y, origin);
            direction = arriving.direction;
            reach = arriving.distance >= RS_FAR ? RS_FAR : arriving.distance * RS_SHADOW_LENGTH;
        }
        bool hit = rsOccluded(origin, direction, reach, previous);
        if (previous) stands.x = hit == onSurface;
        else stands.y = hit == onSurface;
    }
    return stands;
}

#endif
