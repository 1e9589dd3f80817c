// What a reservoir of indirect light holds: a path's second vertex x2 and the radiance Lo that leaves it for the first
// (Ouyang et al. 2021). Lo is the same at every pixel: restir/gi/scatter.glsl keeps what is not out of it.
//
// Measure. Densities, targets and weights are per unit of area at x2,
//     f = BSDF x cosine x Lo x cos(phi) / d^2          phi at x2, between its normal and the direction to x1; d = |x1 - x2|
// so that a sample moves to another pixel with |J| = 1. The reconnection Jacobian
//     |J_{q->r}| = (cos phi_r / cos phi_q) (d_q^2 / d_r^2)
// is what turns weights per solid angle from one pixel's into the other's: here it sits in the two targets. The shift
// is undefined where x2 is seen from behind or from too near.
#ifndef RESTIR_GI_RESERVOIR_GLSL
#define RESTIR_GI_RESERVOIR_GLSL
#include "restir/core/pack.glsl"
#include "restir/di/direct.glsl"
#include "restir/di/reservoir.glsl"
#include "restir/shared/gi.h"

// Least distance of two vertices, as a part of the larger coordinate: below it the direction is rounding.
#define RS_GI_LEAST_DISTANCE 1e-5

bool rsHasSample(RsGiReservoir r) { return r.ucw > 0.0; }
uint rsConfidence(RsGiReservoir r) { return r.confidence & 0xffffu; }
uint rsAge(RsGiReservoir r) { return r.confidence >> 16u; }

RsGiReservoir rsEmptyGiReservoir(uint confidence) {
    return RsGiReservoir(vec3(0.0), 0u, uvec2(0u), 0.0, min(confidence, RS_MAX_CONFIDENCE));
}

// The same sample with another weight; what is not finite and >= 0 becomes 0.
RsGiReservoir rsKeep(RsGiReservoir r, float ucw, uint confidence) {
    if (!rsIsWeight(ucw)) {
        rsOnRejectedWeight();
        ucw = 0.0;
    }
    if (ucw == 0.0) return rsEmptyGiReservoir(confidence);
    r.ucw = ucw;
    r.confidence = min(confidence, RS_MAX_CONFIDENCE) | (rsAge(r) << 16u);
    return r;
}

// x2 as a light: d omega = solidAngle d area.
RsIncident rsIncidentFrom(RsGiReservoir r, vec3 receiver) {
    RsIncident none = RsIncident(vec3(0.0, 0.0, 1.0), 0.0, vec3(0.0), 0.0);
    vec3 toVertex = r.position - receiver, size = max(abs(r.position), abs(receiver));
    float distance = length(toVertex);
    if (!(distance > RS_GI_LEAST_DISTANCE * max(size.x, max(size.y, size.z)))) return none;
    vec3 direction = toVertex / distance;
    float cosVertex = -dot(rsUnpackNormal(r.normal), direction);
    if (!(cosVertex > 0.0)) return none;
    float solidAngle = cosVertex / (distance * distance);
    return RsIncident(direction, distance, rsUnpackFineRadiance(r.radiance) * solidAngle, solidAngle);
}

// Paths are taken as they were found: last frame's as if nothing had changed behind x2.
RsDirect rsEvaluate(RsSurface s, RsGiReservoir r, bool previous) {
    return rsReflect(s, rsIncidentFrom(r, rsRayOrigin(s)));
}

#endif
