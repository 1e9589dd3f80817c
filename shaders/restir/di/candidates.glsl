// Fresh candidates in two stages (Talbot et al. 2005; Veach 1997).
//   1. n_l lights from the power table, resampled by p^ / (n_l p_l); a shadow ray to the survivor finds its V.
//   2. The survivor, weighted m_l = n_l p_l / (n_l p_l + n_b p_b V), against n_b BSDF directions that hit a light,
//      weighted p^ / (n_l p_l + n_b p_b).
// m_l + V m_b = 1 everywhere, so the reservoir covers occluded points too unless `kill` drops them, and either is
// unbiased for its own target. A miss counts.
#ifndef RESTIR_DI_CANDIDATES_GLSL
#define RESTIR_DI_CANDIDATES_GLSL
#include "restir/di/direct.glsl"
#include "restir/di/reservoir.glsl"

uint rsBridgeLight(RsHit hit);   // light id of what was hit, RS_NO_LIGHT for none

struct RsChosenLight {
    uint light;
    uint uv;
    float ucw;
    float selection;   // p_l of the chosen light
    RsDirect direct;
};

RsChosenLight rsResampleLights(RsSurface s, uint lightCount, uint candidates, inout RsRandom random) {
    RsChosenLight chosen;
    chosen.light = RS_NO_LIGHT;
    chosen.ucw = 0.0;
    chosen.direct.target = 0.0;
    float sum = 0.0;
    for (uint i = 0u; lightCount > 0u && i < candidates; ++i) {
        uint id = rsSampleLight(lightCount, random);
        RsPackedLight light = rsLoadLight(id);
        uint uv = rsSampleLightUv(light, rsNextBits(random));
        RsDirect direct = rsDirect(s, light, uv);
        float coin = rsNext(random);
        if (direct.target == 0.0 || light.selection <= 0.0) continue;
        float weight = direct.target / (float(candidates) * light.selection);
        sum += weight;
        if (coin * sum < weight) chosen = RsChosenLight(id, uv, 0.0, light.selection, direct);
    }
    if (chosen.direct.target > 0.0) chosen.ucw = sum / chosen.direct.target;
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

RsReservoir rsDiCandidates(RsSurface s, uint lightCount, RsDiConstants di, inout RsRandom random) {
    RsChosenLight survivor = rsResampleLights(s, lightCount, di.lightCandidates, random);
    bool kill = di.visibility != RS_VISIBILITY_NONE;
    if (di.bsdfCandidates == 0u && !kill)
        return rsMakeReservoir(survivor.light, survivor.uv, survivor.ucw, 1u, 0u);

    float nl = float(di.lightCandidates), nb = float(di.bsdfCandidates);
    uint light = survivor.light, uv = survivor.uv;
    float target = survivor.direct.target, sum = 0.0;
    if (survivor.ucw > 0.0) {
        bool visible = rsUnoccluded(s, survivor.direct.incident);
        float pb = 0.0;
        if (visible && nb > 0.0)
            pb = rsBridgeBsdfPdf(s, survivor.direct.incident.direction) * survivor.direct.incident.solidAngle;
        float mis = nl * survivor.selection / (nl * survivor.selection + nb * pb);
        if (visible || !kill) sum = mis * target * survivor.ucw;
    }
    for (uint i = 0u; lightCount > 0u && i < di.bsdfCandidates; ++i) {
        vec3 direction = rsBridgeSampleBsdf(s, vec3(rsNext2(random), rsNext(random)));
        RsBsdfCandidate found = rsBsdfCandidate(s, direction, nl, nb);
        float coin = rsNext(random);
        if (found.weight <= 0.0) continue;
        sum += found.weight;
        if (coin * sum < found.weight) {
            light = found.light;
            uv = found.uv;
            target = found.target;
        }
    }
    return sum > 0.0 ? rsMakeReservoir(light, uv, sum / target, 1u, 0u) : rsEmptyReservoir(1u);
}

#endif
