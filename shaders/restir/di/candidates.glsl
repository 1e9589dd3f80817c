// Fresh candidates in two stages (Talbot et al. 2005; Veach 1997).
//   1. n rounds of k lights from restir/lights/source.glsl, each resampled by p^ / (k p_l); a shadow ray to each survivor finds
//      its V. With W = sum / p^ a survivor is an unbiased sample of all that is lit, occluded or not.
//      p_l is the light's probability times the density of the point for this receiver (restir/lights/light.glsl).
//   2. The survivors, weighted m_r p^ W with m_r = k p_l / (n k p_l + n_b p_b V), against n_b BSDF directions that hit a
//      light, weighted p^ / (n k p_l + n_b p_b): the balance heuristic over all n k + n_b candidates.
// Where V = 1 the n equal m_r and the directions' share n_b p_b / (n k p_l + n_b p_b) add up to 1, where V = 0 the n m_r
// alone do, each 1 / n. p_b is 0 for lights that no ray finds. So the reservoir covers occluded points too unless `kill` drops them, and either is unbiased for
// its own target. A miss counts. Whatever was found, the confidence is that of the rounds: 1 for a frame's usual number.
#ifndef RESTIR_DI_CANDIDATES_GLSL
#define RESTIR_DI_CANDIDATES_GLSL
#include "restir/di/direct.glsl"
#include "restir/di/reservoir.glsl"
#include "restir/lights/source.glsl"

uint rsBridgeLight(RsHit hit);   // light id of what was hit, RS_NO_LIGHT for none
// Ids of the extended lights at infinity, in front, then RS_NO_LIGHT. i < RS_INFINITE_LIGHTS
uint rsInfiniteLight(uint i);

struct RsChosenLight {
    uint light;
    uint uv;
    float sum;         // of the resampling weights: p^ W of the survivor; 0: none
    float pdf;         // its p_l
    bool found;        // whether BSDF directions find it, too
    RsDirect direct;
};

RsChosenLight rsResampleLights(RsSurface s, RsLightSource source, uint candidates, inout RsRandom random) {
    RsChosenLight chosen;
    chosen.sum = 0.0;
    vec3 receiver = rsRayOrigin(s);
    for (uint i = 0u; source.count > 0u && i < candidates; ++i) {
        RsLightDraw draw = rsDrawLightFrom(source, receiver, s.normal, random);
        RsPackedLight light = rsLoadLight(draw.light);
        float seen;
        uint uv = rsSampleLightUv(light, receiver, random, seen);
        RsDirect direct = rsDirect(s, light, uv);
        float coin = rsNext(random);
        float pdf = 0.0;
        if (direct.target > 0.0) {
            float chance = rsLightChance(source, draw, light.selection, receiver, s.normal);
            pdf = rsPdfLight(chance, light, uv, direct.incident, seen);
        }
        if (!(pdf > 0.0)) continue;
        float weight = direct.target / (float(candidates) * pdf);
        float sum = chosen.sum + weight;
        if (coin * sum < weight) chosen = RsChosenLight(draw.light, uv, sum, pdf, rsIsFoundByRays(light), direct);
        chosen.sum = sum;
    }
    return chosen;
}

// Both ways of finding lights: how many candidates of each there are, n k and n_b.
struct RsStrategies {
    RsLightSource source;
    float lights;
    float directions;
};

// The second stage while it runs.
struct RsFresh {
    uint light;
    uint uv;
    float target;
    float sum;
};

void rsOffer(inout RsFresh fresh, uint light, uint uv, float target, float weight, float coin) {
    fresh.sum += weight;
    if (coin * fresh.sum < weight) fresh = RsFresh(light, uv, target, fresh.sum);
}

// A point of a light that a BSDF direction found.
void rsOfferFound(inout RsFresh fresh, RsSurface s, uint id, RsPackedLight light, uint uv, RsStrategies n, float coin) {
    RsDirect direct = rsDirect(s, light, uv);
    float pdf = rsBridgeBsdfPdf(s, direct.incident.direction) * direct.incident.solidAngle;
    if (!(direct.target > 0.0 && pdf > 0.0)) return;
    float chance = rsLightChance(n.source, id, light.selection, rsRayOrigin(s), s.normal);
    float lightPdf = rsPdfLight(chance, light, uv, direct.incident, 0.0);
    float weight = direct.target / (n.lights * lightPdf + n.directions * pdf);
    rsOffer(fresh, id, uv, direct.target, weight, coin);
}

// What a BSDF direction finds: the triangle that it hits, else all there is at infinity, each light a candidate of its own.
void rsOfferDirection(inout RsFresh fresh, RsSurface s, vec3 direction, RsStrategies n, inout RsRandom random) {
    if (!(rsBridgeBsdfPdf(s, direction) > 0.0)) return;
    RsHit hit = rsClosestHit(rsRayOrigin(s), direction, RS_FAR);
    bool missed = hit.t < 0.0;
    uint count = missed ? RS_INFINITE_LIGHTS : 1u;
    for (uint i = 0u; i < count; ++i) {
        uint id = RS_NO_LIGHT, uv = 0u;
        if (missed) id = rsInfiniteLight(i);
        else id = rsBridgeLight(hit);
        if (id == RS_NO_LIGHT) return;
        RsPackedLight light = rsLoadLight(id);
        bool found = rsLightKind(light) == RS_LIGHT_TRIANGLE;
        if (missed) found = rsFindAtInfinity(light, direction, uv);
        else uv = rsPackUv(hit.barycentrics);
        if (found) rsOfferFound(fresh, s, id, light, uv, n, rsNext(random));
    }
}

RsReservoir rsDiCandidates(RsSurface s, uint lightCount, RsDiConstants di, inout RsRandom random) {
    bool kill = di.visibility != RS_VISIBILITY_NONE;
    bool traced = kill || di.bsdfCandidates > 0u;   // else V changes nothing
    float perRound = float(di.lightCandidates), nl = float(di.initialSamples) * perRound, nb = float(di.bsdfCandidates);
    RsLightSource source = rsSourceAt(RsLightSource(lightCount, di.treeShare), rsRayOrigin(s));
    RsFresh fresh = RsFresh(RS_NO_LIGHT, 0u, 0.0, 0.0);
    for (uint i = 0u; i < di.initialSamples; ++i) {
        RsChosenLight survivor = rsResampleLights(s, source, di.lightCandidates, random);
        float coin = rsNext(random);
        if (!(survivor.sum > 0.0)) continue;
        RsIncident incident = survivor.direct.incident;
        bool visible = !traced || rsUnoccluded(s, incident);
        if (kill && !visible) continue;
        bool either = visible && nb > 0.0 && survivor.found;
        float pb = either ? rsBridgeBsdfPdf(s, incident.direction) * incident.solidAngle : 0.0;
        float mis = perRound * survivor.pdf / (nl * survivor.pdf + nb * pb);
        rsOffer(fresh, survivor.light, survivor.uv, survivor.direct.target, mis * survivor.sum, coin);
    }
    for (uint i = 0u; lightCount > 0u && i < di.bsdfCandidates; ++i) {
        vec3 direction = rsBridgeSampleBsdf(s, vec3(rsNext2(random), rsNext(random)));
        rsOfferDirection(fresh, s, direction, RsStrategies(source, nl, nb), random);
    }
    return fresh.sum > 0.0 ? rsMakeReservoir(fresh.light, fresh.uv, fresh.sum / fresh.target, di.freshConfidence, 0u)
                           : rsEmptyReservoir(di.freshConfidence);
}

#endif
