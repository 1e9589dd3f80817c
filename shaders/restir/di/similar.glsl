// Which surfaces share reservoirs. Nothing here looks at a sample.
#ifndef RESTIR_DI_SIMILAR_GLSL
#define RESTIR_DI_SIMILAR_GLSL
#include "restir/core/surface.glsl"
#include "restir/shared/di.h"

#define RS_ACCEPTED 0u
#define RS_REJECTED_NORMAL 1u
#define RS_REJECTED_DEPTH 2u
#define RS_REJECTED_EMPTY 3u     // no surface
#define RS_REJECTED_OUTSIDE 4u   // of the image, or the pixel itself

// In one frame: normals alike, and the neighbour close to this surface's plane, relative to the distance. Unlike a
// difference of depths that does not reject the floor seen at a slant.
uint rsCompareInFrame(RsSurface s, RsSurface other, RsDiConstants di) {
    if (!other.valid) return RS_REJECTED_EMPTY;
    if (!(dot(s.normal, other.normal) >= di.normalThreshold)) return RS_REJECTED_NORMAL;
    float offPlane = abs(dot(s.geometricNormal, other.position - s.position));
    return offPlane <= di.depthThreshold * s.depth ? RS_ACCEPTED : RS_REJECTED_DEPTH;
}

// Across frames: where motion comes from the host the surface itself may have moved, so depths are compared, with
// `expectedDepth` that of this surface in the other view.
bool rsSimilarAcrossFrames(RsSurface s, RsSurface other, float expectedDepth, RsDiConstants di) {
    return other.valid && dot(s.normal, other.normal) >= di.normalThreshold &&
           abs(other.depth - expectedDepth) <= di.depthThreshold * expectedDepth;
}

#endif
