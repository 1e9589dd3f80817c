// What combination asks of a reservoir's sample: here, a point on a light.
#ifndef RESTIR_DI_SAMPLE_GLSL
#define RESTIR_DI_SAMPLE_GLSL
#include "restir/di/direct.glsl"
#include "restir/di/reservoir.glsl"

// f and p^ of the sample at another surface; `previous`: with last frame's lights.
RsDirect rsEvaluate(RsSurface s, RsReservoir r, bool previous) {
    RsPackedLight light = previous ? rsLoadPreviousLight(r.light) : rsLoadLight(r.light);
    return rsDirect(s, light, r.uv);
}

// V of the sample at another surface: a ray.
bool rsIsSeen(RsSurface s, RsReservoir r, RsIncident incident, bool previous) { return rsUnoccluded(s, incident, previous); }

// The same sample with another weight.
RsReservoir rsKeep(RsReservoir r, float ucw, uint confidence) {
    return rsMakeReservoir(r.light, r.uv, ucw, confidence, rsAge(r));
}

#endif
