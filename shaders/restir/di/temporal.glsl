// Temporal reuse: the canonical is this frame's fresh reservoir, the neighbour last frame's final one at the
// back-projected pixel, its confidence capped before any weight is formed. Its domain is the previous frame: last
// frame's surface, camera, lights and acceleration structure.
#ifndef RESTIR_DI_TEMPORAL_GLSL
#define RESTIR_DI_TEMPORAL_GLSL
#include "restir/di/combine.glsl"
#include "restir/di/similar.glsl"

RsSurface rsLoadPreviousSurface(uvec2 pixel);
RsReservoir rsLoadHistory(uvec2 pixel);   // confidence capped to max_history

RsNeighbour rsLoadNeighbour(RsNeighbourhood where, uint i) {
    return RsNeighbour(rsLoadPreviousSurface(where.pixel), rsLoadHistory(where.pixel), true);
}

// Where a miss of the exact pixel looks next: a few random offsets of growing size.
#define RS_TEMPORAL_TRIES 4u
#define RS_TEMPORAL_SPREAD 2.0

// `previousPixel` in pixels of the previous frame, jitter included.
RsNeighbourhood rsFindHistory(RsSurface s, vec2 previousPixel, float expectedDepth, uvec2 previousExtent, RsDiConstants di,
                              inout RsRandom random) {
    RsNeighbourhood where = RsNeighbourhood(uvec2(0u), 0.0, vec2(0.0), 1u, 0u, 0.0);
    for (uint i = 0u; i < RS_TEMPORAL_TRIES && where.accepted == 0u; ++i) {
        vec2 offset = (rsNext2(random) * 2.0 - 1.0) * (RS_TEMPORAL_SPREAD * float(i));
        vec2 at = floor(previousPixel + offset);
        if (!(all(greaterThanEqual(at, vec2(0.0))) && all(lessThan(at, vec2(previousExtent))))) continue;
        where.pixel = uvec2(at);
        if (rsSimilarAcrossFrames(s, rsLoadPreviousSurface(where.pixel), expectedDepth, di)) {
            where.accepted = 1u;
            where.confidence = float(rsConfidence(rsLoadHistory(where.pixel)));
        }
    }
    return where;
}

RsReservoir rsDiTemporal(RsSurface s, RsReservoir fresh, vec2 previousPixel, float expectedDepth, uvec2 previousExtent,
                         RsDiConstants di, inout RsRandom random) {
    RsNeighbourhood where = rsFindHistory(s, previousPixel, expectedDepth, previousExtent, di, random);
    return rsCombine(s, fresh, where, di.weights, di.visibility == RS_VISIBILITY_TRACED, random).reservoir;
}

#endif
