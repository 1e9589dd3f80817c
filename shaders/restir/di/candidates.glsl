// Fresh candidates in two stages (Talbot et al. 2005; Veach 1997).
//   1. n rounds of k lights from the power table, each resampled by p^ / (k p_l); a shadow ray to each survivor finds
//      its V. With W = sum / p^ a survivor is an unbiased sample of all that is lit, occluded or not.
//   2. The survivors, weighted m_r p^ W with m_r = k p_l / (n k p_l + n_b p_b V), against n_b BSDF directions that hit a
//      light, weighted p^ / (n k p_l + n_b p_b): the balance heuristic over all n k + n_b candidates.
// Where V = 1 the n equal m_r and the directions' share n_b p_b / (n k p_l + n_b p_b) add up to 1, where V = 0 the n m_r
// alone do, each 1 / n. So the reservoir covers occluded points too unless `kill` drops them, and either is unbiased for
// its own target. A miss counts. Whatever was found, the confidence is that of the rounds: 1 for a frame's usual number.
#ifndef RESTIR_DI_CANDIDATES_GLSL
#define RESTIR_DI_CANDIDATES_GLSL
#include "restir/di/direct.glsl"
#include "restir/di/reservoir.glsl"

uint rsBridgeLight(RsHit hit);   // light id of what was hit, RS_NO_LIGHT for none

struct RsChosenLight {
    uint light;
    uint uv;
    float sum;         // of the resampling weights: p^ W of the survivor; 0: none
    float selection;   // its p_l
    RsDirect direct;
};

RsChosenLight rsResampleLights(RsSurface s, uint lightCount, uint candidates, inout RsRandom random) {
    RsChosenLight chosen;
    chosen.sum = 0.0;
    for (uint i = 0u; lightCount > 0u && i < candidates; ++i) {
        uint id = rsSampleLight(lightCount, random);
        RsPackedLight light = rsLoadLight(id);
        uint uv = rsSampleLightUv(light, rsNextBits(random));
        RsDirect direct = rsDirect(s, light, uv);
        float coin = rsNext(random);
        if (direct.target == 0.0 || light.selection <= 0.0) continue;
        float weight = direct.target / (float(candidates) * light.selection);
        float sum = chosen.sum + weight;
        if (coin * sum < weight) chosen = RsChosenLight(id, uv, sum, light.selection, direct);
        chosen.sum = sum;
    }
    return chosen;
}

// A BSDF direction that found a light: its resampling weight and what it found.
struct RsBsdfCandidate {
    uint light;
    uint uv;
    float weight;
    float target;
};

RsBsdfCandidate rsBsdfCandidate(RsSurface s, vec3 direction, float lightCandidates, float bsdfCandidates) {
    RsBsdfCandidate none = RsBsdfCandidate(RS_NO_LIGHT, 0u, 0.0, 0.0);
    if (!(rsBridgeBsdfPdf(s, direction) > 0.0)) return none;
    RsHit hit = rsClosestHit(rsRayOrigin(s), direction, RS_FAR);
    if (hit.t < 0.0) return none;
    uint id = rsBridgeLight(hit);
    if (id == RS_NO_LIGHT) return none;
    RsPackedLight light = rsLoadLight(id);
    if (rsLightKind(light) != RS_LIGHT_TRIANGLE) return none;
    uint uv = rsPackUv(hit.barycentrics);
    RsDirect direct = rsDirect(s, light, uv);
    float pdf = rsBridgeBsdfPdf(s, direct.incident.direction) * direct.incident.solidAngle;
    if (!(direct.target > 0.0 && pdf > 0.0)) return none;
    float weight = direct.target / (lightCandidates * light.selection + bsdfCandidates * pdf);
    return RsBsdfCandidate(id, uv, weight, direct.target);
}

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

RsReservoir rsDiCandidates(RsSurface s, uint lightCount, RsDiConstants di, inout RsRandom random) {
    bool kill = di.visibility != RS_VISIBILITY_NONE;
    bool traced = kill || di.bsdfCandidates > 0u;   // else V changes nothing
    float perRound = float(di.lightCandidates), nl = float(di.initialSamples) * perRound, nb = float(di.bsdfCandidates);
    RsFresh fresh = RsFresh(RS_NO_LIGHT, 0u, 0.0, 0.0);
    for (uint i = 0u; i < di.initialSamples; ++i) {
        RsChosenLight survivor = rsResampleLights(s, lightCount, di.lightCandidates, random);
        float coin = rsNext(random);
        if (!(survivor.sum > 0.0)) continue;
        RsIncident incident = survivor.direct.incident;
        bool visible = !traced || rsUnoccluded(s, incident);
        if (kill && !visible) continue;
        float pb = visible && nb > 0.0 ? rsBridgeBsdfPdf(s, incident.direction) * incident.solidAngle : 0.0;
        float mis = perRound * survivor.selection / (nl * survivor.selection + nb * pb);
        rsOffer(fresh, survivor.light, survivor.uv, survivor.direct.target, mis * survivor.sum, coin);
    }
    for (uint i = 0u; lightCount > 0u && i < di.bsdfCandidates; ++i) {
        vec3 direction = rsBridgeSampleBsdf(s, vec3(rsNext2(random), rsNext(random)));
        RsBsdfCandidate found = rsBsdfCandidate(s, direction, nl, nb);
        float coin = rsNext(random);
        if (found.weight > 0.0) rsOffer(fresh, found.light, found.uv, found.target, found.weight, coin);
    }
    return fresh.sum > 0.0 ? rsMakeReservoir(fresh.light, fresh.uv, fresh.sum / fresh.target, di.freshConfidence, 0u)
                           : rsEmptyReservoir(di.freshConfidence);
}

#endif
