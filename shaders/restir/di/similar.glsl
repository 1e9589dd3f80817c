// Which surfaces share reservoirs. Nothing here looks at a sample.
#ifndef RESTIR_DI_SIMILAR_GLSL
#define RESTIR_DI_SIMILAR_GLSL
#include "restir/core/surface.glsl"
#include "restir/shared/di.h"

// In one frame: normals alike, and the neighbour close to this surface's plane, relative to the distance. Unlike a
// difference of depths that does not reject the floor seen at a slant.
bool rsSimilarInFrame(RsSurface s, RsSurface other, RsDiConstants di) {
    return other.valid && dot(s.normal, other.normal) >= di.normalThreshold &&
           abs(dot(s.geometricNormal, other.position - s.position)) <= di.depthThreshold * s.depth;
}

// Across frames: where motion comes from the host the surface itself may have moved, so depths are compared, with
// `expectedDepth` that of this surface in the other view.
bool rsSimilarAcrossFrames(RsSurface s, RsSurface other, float expectedDepth, RsDiConstants di) {
    return other.valid && dot(s.normal, other.normal) >= di.normalThreshold &&
           abs(other.depth - expectedDepth) <= di.depthThreshold * expectedDepth;
}

#endif
