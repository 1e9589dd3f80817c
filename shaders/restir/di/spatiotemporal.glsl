// Temporal and spatial reuse in one pass. Temporal reuse first: the fresh reservoir with last frame's at the
// back-projected pixel. The result is the canonical among last frame's reservoirs on a spiral around that pixel. (All at
// once with the fresh one as canonical would be as unbiased, but pairwise weights lean on the canonical wherever a
// neighbour cannot hold a sample, and one frame's candidates are little to lean on.)
// Every neighbour lives in the previous frame: last frame's surfaces, camera, lights and acceleration structure.
#ifndef RESTIR_DI_SPATIOTEMPORAL_GLSL
#define RESTIR_DI_SPATIOTEMPORAL_GLSL
#include "restir/di/history.glsl"
#include "restir/di/spiral.glsl"

RsNeighbour rsLoadNeighbour(RsNeighbourhood where, uint i) {
    uvec2 at = uvec2(max(rsNeighbourPixel(where, i), ivec2(0)));   // radius 0: the pixel itself
    return RsNeighbour(rsLoadPreviousSurface(at), rsLoadHistory(at), true);
}

// Where nothing similar was found the spiral starts at the nearest pixel of the last frame. NaN becomes 0.
uvec2 rsNearestPixel(vec2 at, uvec2 extent) {
    vec2 last = vec2(extent) - 1.0;
    return uvec2(at.x > 0.0 ? min(at.x, last.x) : 0.0, at.y > 0.0 ? min(at.y, last.y) : 0.0);
}

// Neighbours are compared with the surface where history was found, as it was then: it may have moved.
RsNeighbourhood rsFindPreviousNeighbours(RsSurface s, RsNeighbourhood history, RsBackProjection back, RsDiConstants di,
                                         inout RsRandom random) {
    uvec2 centre = history.pixel;
    if (history.accepted != 0u) s = rsLoadPreviousSurface(centre);
    else centre = rsNearestPixel(back.pixel, back.extent);
    RsNeighbourhood where = RsNeighbourhood(centre, di.previousField, di.radius, rsNext2(random), di.neighbours, 0u, 0.0);
    for (uint i = 0u; i < where.count; ++i) {
        ivec2 at = rsNeighbourPixel(where, i);
        if (!rsIsInside(at, back.extent) || uvec2(at) == centre) continue;
        if (rsCompareInFrame(s, rsLoadPreviousSurface(uvec2(at)), di) != RS_ACCEPTED) continue;
        where.accepted |= 1u << i;
        where.confidence += float(rsConfidence(rsLoadHistory(uvec2(at))));
    }
    return where;
}

RsCombined rsDiSpatiotemporal(RsSurface s, RsReservoir fresh, RsBackProjection back, RsDiConstants di,
                              inout RsRandom random) {
    bool traced = di.visibility == RS_VISIBILITY_TRACED;
    RsNeighbourhood history = rsFindHistory(s, back, di, random);
    RsReservoir canonical = rsCombine(s, fresh, history, di.weights, traced, random).reservoir;
    RsNeighbourhood around = rsFindPreviousNeighbours(s, history, back, di, random);
    return rsCombine(s, canonical, around, di.weights, traced, random);
}

#endif
