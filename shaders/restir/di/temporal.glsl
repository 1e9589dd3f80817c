// Temporal reuse: the canonical is this frame's fresh reservoir, the neighbour last frame's final one at the
// back-projected pixel, its confidence capped before any weight is formed. Its domain is the previous frame: last
// frame's surface, camera, lights and acceleration structure.
#ifndef RESTIR_DI_TEMPORAL_GLSL
#define RESTIR_DI_TEMPORAL_GLSL
#include "restir/di/history.glsl"

RsNeighbour rsLoadNeighbour(RsNeighbourhood where, uint i) {
    return RsNeighbour(rsLoadPreviousSurface(where.pixel), rsLoadHistory(where.pixel), true);
}

RsReservoir rsDiTemporal(RsSurface s, RsReservoir fresh, RsBackProjection back, RsDiConstants di,
                         inout RsRandom random) {
    RsNeighbourhood where = rsFindHistory(s, back, di, random);
    return rsCombine(s, fresh, where, di.weights, di.visibility == RS_VISIBILITY_TRACED, random).reservoir;
}

#endif
