// A fresh path: a direction from the BSDF, and the light that comes back from what it hits. Emission of that is direct
// light and left to ReSTIR DI, as is what a miss would see. Up to three arrivals at the hit are added up; a reservoir
// keeps one of them by its share of that.
#ifndef RESTIR_GI_CANDIDATES_GLSL
#define RESTIR_GI_CANDIDATES_GLSL
#include "restir/gi/reservoir.glsl"
#include "restir/gi/arrive.glsl"

struct RsGiFresh {
    RsGiReservoir reservoir;
    RsShading shading;   // what all of them bring to the pixel
    float sum;           // of targets times weights
};

void rsOffer(inout RsGiFresh fresh, RsSurface s, RsGiReservoir r, float coin) {
    RsDirect direct = rsEvaluate(s, r, false);
    float weight = direct.target * r.ucw;
    if (!(weight > 0.0 && weight < 3e38)) return;   // infinity from hostile input counts as unlit
    rsAddLight(fresh.shading, s, direct, r.ucw);
    fresh.sum += weight;
    if (coin * fresh.sum < weight) fresh.reservoir = r;
}

void rsOfferLight(inout RsGiFresh fresh, RsSurface s, RsGiReservoir r, RsLightArrival arrival, float pdf, inout RsRandom random) {
    float coin = rsNext(random);
    r.arrival = uvec2(arrival.light, arrival.uv);
    r.ucw = arrival.weight / pdf;
    if (arrival.weight > 0.0) rsOffer(fresh, s, r, coin);
}

void rsOfferFollowed(inout RsGiFresh fresh, RsSurface s, RsGiReservoir r, RsFollowed arrival, float pdf, inout RsRandom random) {
    float coin = rsNext(random);
    vec3 rounding = vec3(rsNext2(random), rsNext(random));
    float largest = max(arrival.radiance.x, max(arrival.radiance.y, arrival.radiance.z));
    r.surface.z |= RS_GI_FOLLOWED;
    r.arrival = uvec2(arrival.direction, rsPackShares(arrival.radiance / largest, rounding));
    r.ucw = largest / pdf;
    if (largest > 0.0) rsOffer(fresh, s, r, coin);
}

// `bounces`: scattering events, that at `s` among them; at least 2.
RsGiFresh rsGiCandidate(RsSurface s, RsLightSource source, uint bounces, uint lightCandidates, inout RsRandom random) {
    RsGiFresh fresh = RsGiFresh(rsEmptyGiReservoir(1u), rsNoLight(), 0.0);
    vec3 direction = rsBridgeSampleBsdf(s, vec3(rsNext2(random), rsNext(random)));
    if (!(rsBridgeBsdfPdf(s, direction) > 0.0)) return fresh;
    vec3 origin = rsRayOrigin(s);
    RsHit hit = rsClosestHit(origin, direction, RS_FAR);
    if (hit.t < 0.0) return fresh;
    RsSurface there = rsBridgeHit(hit, origin, direction);
    if (!there.valid) return fresh;
    RsGiReservoir r = rsVertexOf(there);
    RsIncident incident = rsSeeVertex(r, origin);   // from what is stored
    float pdf = rsBridgeBsdfPdf(s, incident.direction) * incident.solidAngle;
    if (!(pdf > 0.0)) return fresh;

    RsSurface x2 = rsVertexSeen(r, -incident.direction);
    x2.depth = there.depth;
    RsArriving light = rsArriving(x2, source, bounces - 1u, lightCandidates, random);
    rsOfferLight(fresh, s, r, light.drawn, pdf, random);
    rsOfferLight(fresh, s, r, light.found, pdf, random);
    rsOfferFollowed(fresh, s, r, light.followed, pdf, random);
    if (fresh.sum > 0.0) fresh.reservoir = rsKeep(fresh.reservoir, fresh.sum / rsEvaluate(s, fresh.reservoir, false).target, 1u);
    return fresh;
}

#endif
