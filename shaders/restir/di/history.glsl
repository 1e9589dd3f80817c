// Where a surface was in the last frame.
#ifndef RESTIR_DI_HISTORY_GLSL
#define RESTIR_DI_HISTORY_GLSL
#include "restir/di/combine.glsl"
#include "restir/di/field.glsl"
#include "restir/di/similar.glsl"

RsSurface rsLoadPreviousSurface(uvec2 pixel);
RsReservoir rsLoadHistory(uvec2 pixel);   // confidence capped to max_history

// The back-projected surface; `pixel` in pixels of the previous frame, jitter included.
struct RsBackProjection {
    vec2 pixel;
    float depth;   // expected there
    uvec2 extent;
};

// The pixel mirrored within its block of 4 x 4: a permutation, so that no reservoir is read twice.
ivec2 rsPermuted(ivec2 pixel, uint permutation) {
    ivec2 corner = ivec2(permutation & 3u, permutation >> 2u & 3u);
    return ((pixel + corner) ^ 3) - corner;
}

// Where a miss of the exact pixel looks next: a few random offsets of growing size.
#define RS_TEMPORAL_TRIES 4u
#define RS_TEMPORAL_SPREAD 2.0

RsNeighbourhood rsFindHistory(RsSurface s, RsBackProjection back, RsDiConstants di, inout RsRandom random) {
    RsNeighbourhood where = RsNeighbourhood(uvec2(0u), di.previousField, 0.0, vec2(0.0), 1u, 0u, 0.0);
    for (uint i = di.permutation != 0u ? 0u : 1u; i <= RS_TEMPORAL_TRIES && where.accepted == 0u; ++i) {
        vec2 offset = (rsNext2(random) * 2.0 - 1.0) * (RS_TEMPORAL_SPREAD * float(max(i, 1u) - 1u));
        vec2 at = floor(back.pixel + offset);
        if (!(all(greaterThanEqual(at, vec2(0.0))) && all(lessThan(at, vec2(back.extent))))) continue;
        ivec2 pixel = ivec2(at);
        if (i == 0u) pixel = rsPermuted(pixel, di.permutation);   // ahead of the others
        pixel = rsOnField(pixel, di.previousField);
        if (!rsIsInside(pixel, back.extent)) continue;
        where.pixel = uvec2(pixel);
        if (rsSimilarAcrossFrames(s, rsLoadPreviousSurface(where.pixel), back.depth, di)) {
            where.accepted = 1u;
            where.confidence = float(rsConfidence(rsLoadHistory(where.pixel)));
        }
    }
    return where;
}

#endif
