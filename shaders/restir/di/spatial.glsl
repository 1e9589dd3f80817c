// Spatial reuse: neighbours of this frame on a spiral around the pixel, turned and scaled by its random numbers, read
// from a snapshot.
#ifndef RESTIR_DI_SPATIAL_GLSL
#define RESTIR_DI_SPATIAL_GLSL
#include "restir/di/similar.glsl"
#include "restir/di/spiral.glsl"

RsSurface rsLoadSurface(uvec2 pixel);
RsReservoir rsLoadSource(uvec2 pixel);

RsNeighbour rsLoadNeighbour(RsNeighbourhood where, uint i) {
    uvec2 at = uvec2(max(rsNeighbourPixel(where, i), ivec2(0)));
    return RsNeighbour(rsLoadSurface(at), rsLoadSource(at), false);
}

RsNeighbourhood rsNeighbourhood(uvec2 pixel, RsDiConstants di, inout RsRandom random) {
    return RsNeighbourhood(pixel, di.field, di.radius, rsNext2(random), di.neighbours, 0u, 0.0);
}

// RS_ACCEPTED, or why not.
uint rsJudgeNeighbour(RsSurface s, ivec2 at, uvec2 pixel, uvec2 extent, RsDiConstants di) {
    if (!rsIsInside(at, extent) || uvec2(at) == pixel) return RS_REJECTED_OUTSIDE;
    return rsCompareInFrame(s, rsLoadSurface(uvec2(at)), di);
}

RsNeighbourhood rsFindNeighbours(RsSurface s, uvec2 pixel, uvec2 extent, RsDiConstants di, inout RsRandom random) {
    RsNeighbourhood where = rsNeighbourhood(pixel, di, random);
    for (uint i = 0u; i < di.neighbours; ++i) {
        ivec2 at = rsNeighbourPixel(where, i);
        if (rsJudgeNeighbour(s, at, pixel, extent, di) != RS_ACCEPTED) continue;
        where.accepted |= 1u << i;
        where.confidence += float(rsConfidence(rsLoadSource(uvec2(at))));
    }
    return where;
}

RsCombined rsDiSpatial(RsSurface s, RsReservoir canonical, uvec2 pixel, uvec2 extent, RsDiConstants di,
                       inout RsRandom random) {
    RsNeighbourhood where = rsFindNeighbours(s, pixel, extent, di, random);
    return rsCombine(s, canonical, where, di.weights, di.visibility == RS_VISIBILITY_TRACED, random);
}

#endif
