// The pixels that a frame leaves out of indirect light. One that has nobody around on its surface traces a path of its own.
#ifndef RESTIR_GI_FILL_GLSL
#define RESTIR_GI_FILL_GLSL
#include "restir/di/around.glsl"
#include "restir/gi/candidates.glsl"

RsShading rsGiFill(RsSurface s, uvec2 pixel, uvec2 extent, RsLightSource source, uint bounces, bool distances, RsDiConstants gi,
                   inout RsRandom random) {
    RsShading shading;
    if (rsFromAround(s, pixel, extent, distances, gi, shading)) return shading;
    return rsGiCandidate(s, source, bounces, gi.lightCandidates, random).shading;
}

#endif
