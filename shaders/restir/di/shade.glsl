// Final shading: f(Y) V W. With RS_VISIBILITY_TRACED the reservoir is visible already; the others trace here, and
// only RS_VISIBILITY_CACHED keeps the answer.
#ifndef RESTIR_DI_SHADE_GLSL
#define RESTIR_DI_SHADE_GLSL
#include "restir/di/direct.glsl"
#include "restir/di/reservoir.glsl"

vec3 rsDiShade(RsSurface s, RsReservoir r, uint visibility, out bool occluded) {
    occluded = false;
    if (!rsHasSample(r)) return vec3(0.0);
    RsDirect direct = rsDirect(s, rsLoadLight(r.light), r.uv);
    if (direct.target <= 0.0) return vec3(0.0);
    occluded = visibility != RS_VISIBILITY_TRACED && !rsUnoccluded(s, direct.incident);
    return occluded ? vec3(0.0) : direct.integrand * r.ucw;
}

#endif
