// Final shading: f(Y) V W. With RS_VISIBILITY_TRACED the reservoir is visible already; the others trace here, and
// only RS_VISIBILITY_CACHED keeps the answer.
#ifndef RESTIR_DI_SHADE_GLSL
#define RESTIR_DI_SHADE_GLSL
#include "restir/di/sample.glsl"

RsShading rsDiShade(RsSurface s, RsReservoir r, uint visibility, out bool occluded) {
    RsShading shading = rsNoLight();
    occluded = false;
    if (!rsHasSample(r)) return shading;
    RsDirect direct = rsEvaluate(s, r, false);
    if (direct.target <= 0.0) return shading;
    occluded = visibility != RS_VISIBILITY_TRACED && !rsUnoccluded(s, direct.incident);
    if (!occluded) rsAddLight(shading, s, direct, r.ucw);
    return shading;
}

#endif
