// What a reservoir of indirect light holds: a path's second vertex x2 as a surface, and what arrives there (Ouyang et al.
// 2021, who keep what leaves x2 instead). That is one of two, whose sum is all:
//   a point on a light     looked up again in each frame's table, so that light which changes is followed at once
//   radiance L             from a direction that the path followed, with all that is behind it as it was found
// At x2 and at the pixel the BSDF is evaluated anew, so that glossy second vertices are reused as others are.
//
// Measure. Densities, targets and weights are per unit of area at x2 (and of the light's domain, restir/lights/light.glsl),
//     f = BSDF(x1) x cosine x BSDF(x2) x cosine x L x cos(phi) / d^2          phi at x2, between its normal and the
//                                                                             direction to x1; d = |x1 - x2|
// so that a sample moves to another pixel with |J| = 1. The reconnection Jacobian
//     |J_{q->r}| = (cos phi_r / cos phi_q) (d_q^2 / d_r^2)
// is what turns weights per solid angle from one pixel's into the other's: here it sits in the two targets. The shift
// is undefined where x2 is seen from behind or from too near. L is over the density of all that is behind x2, a constant of the
// sample: it cancels in every weight m, which compares targets of one sample, and so W has it as a factor, but for its colour.
#ifndef RESTIR_GI_RESERVOIR_GLSL
#define RESTIR_GI_RESERVOIR_GLSL
#include "restir/core/pack.glsl"
#include "restir/di/direct.glsl"
#include "restir/di/reservoir.glsl"
#include "restir/shared/gi.h"

// Least distance of two vertices, as a part of the larger coordinate: below it the direction is rounding.
#define RS_GI_LEAST_DISTANCE 1e-5

// Hooks of the passes: RsFrame::giStale; whether the sample that is asked for could have been found in that frame (stands.glsl).
float rsStaleShare();
bool rsStands(bool previous);

bool rsHasSample(RsGiReservoir r) { return r.ucw > 0.0; }
uint rsConfidence(RsGiReservoir r) { return r.confidence & 0xffffu; }
uint rsAge(RsGiReservoir r) { return r.confidence >> 16u; }

RsGiReservoir rsEmptyGiReservoir(uint confidence) {
    return RsGiReservoir(vec3(0.0), 0u, uvec4(0u), uvec2(0u), 0.0, min(confidence, RS_MAX_CONFIDENCE));
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

// x2 as it is kept, with nothing arriving yet.
RsGiReservoir rsVertexOf(RsSurface x2) {
    RsGiReservoir r = rsEmptyGiReservoir(0u);
    RsPackedSurface packed = rsPackSurface(x2);
    r.position = x2.position;
    r.geometricNormal = packed.geometry.z;
    r.surface = uvec4(packed.geometry.yw, packed.material);
    return r;
}

// And back, seen from a direction on its side; without depth and validity.
RsSurface rsVertexSeen(RsGiReservoir r, vec3 view) {
    uvec4 geometry = uvec4(0u, r.surface.x, r.geometricNormal, r.surface.y);
    RsSurface x2 = rsUnpackSurface(RsPackedSurface(geometry, r.surface.zw), r.position, view);
    rsFaceViewer(x2);
    return x2;
}

// What leaves x2. `previous`: with last frame's lights.
vec3 rsScattered(RsSurface x2, RsGiReservoir r, bool previous) {
    vec3 direction = rsUnpackNormal(r.arrival.x), arriving = rsUnpackShares(r.arrival.y);
    if ((r.surface.z & RS_GI_FOLLOWED) == 0u) {
        RsPackedLight light = previous ? rsLoadPreviousLight(r.arrival.x) : rsLoadLight(r.arrival.x);
        RsIncident incident = rsIncident(light, r.arrival.y, rsRayOrigin(x2));
        direction = incident.direction;
        arriving = incident.irradiance;
    }
    return arriving * rsBridgeBsdf(x2, direction);
}

// x2 as a light: d omega = solidAngle d area. Dark as yet; solidAngle 0: the shift is undefined.
RsIncident rsSeeVertex(RsGiReservoir r, vec3 receiver) {
    RsIncident none = RsIncident(vec3(0.0, 0.0, 1.0), 0.0, vec3(0.0), 0.0);
    vec3 toVertex = r.position - receiver, size = max(abs(r.position), abs(receiver));
    float distance = length(toVertex);
    if (!(distance > RS_GI_LEAST_DISTANCE * max(size.x, max(size.y, size.z)))) return none;
    vec3 direction = toVertex / distance;
    float cosVertex = -dot(rsUnpackNormal(r.geometricNormal), direction);
    if (!(cosVertex > 0.0)) return none;
    float solidAngle = cosVertex / (distance * distance);
    return RsIncident(direction, distance, vec3(0.0), solidAngle);
}

// What a path found behind x2 is old news where lights or geometry have changed: it counts as if last frame's pixels had hardly
// been able to find it (a proxy for p^ there, the same for all that asks; section 4), which leaves it to fresh paths.
RsDirect rsEvaluate(RsSurface s, RsGiReservoir r, bool previous) {
    RsIncident incident = rsSeeVertex(r, rsRayOrigin(s));
    if (incident.solidAngle > 0.0)
        incident.irradiance = incident.solidAngle * rsScattered(rsVertexSeen(r, -incident.direction), r, previous);
    RsDirect direct = rsReflect(s, incident);
    if (previous && (r.surface.z & RS_GI_FOLLOWED) != 0u) direct.target *= rsStaleShare();
    return direct;
}

// V of the path to x2, which the pass may know not to be there.
bool rsIsSeen(RsSurface s, RsGiReservoir r, RsIncident incident, bool previous) {
    return rsStands(previous) && rsUnoccluded(s, incident, previous);
}

#endif
