// GRIS over a canonical reservoir and up to 16 neighbours (Lin et al. 2022), with the weights of Settings::weights:
//   Off       m_i = c_i / sum c
//   Basic     m_i = c_i [p^_i(y) > 0] / sum c_j [p^_j(y) > 0]          (O(k): normalised at the selected sample)
//   Balance   m_i = c_i p^_i(y) / sum c_j p^_j(y)                      (likewise)
//   Pairwise  Bitterli 2022, defensive: with S = sum of the neighbours' c
//             m_i = S/(S+c_c) c_i p^_i / (c_c p^_c + S p^_i)
//             m_c = S/(S+c_c) sum (c_i/S) c_c p^_c / (c_c p^_c + S p^_i) + c_c/(S+c_c)
// The shift is the identity on the light with |J| = 1 (restir/lights/light.glsl). With RS_VISIBILITY_TRACED p^_i
// contains the neighbour's V_i: 1 for its own sample, since that reservoir is visibility-limited, a ray for any other.
// The canonical's own V is left to one last ray that zeroes W.
// Nothing here but p^ and W depends on what was sampled: acceptance, confidences and S come from surfaces and counts.
#ifndef RESTIR_DI_COMBINE_GLSL
#define RESTIR_DI_COMBINE_GLSL
#include "restir/di/direct.glsl"
#include "restir/di/reservoir.glsl"

// One domain to take a sample from.
struct RsNeighbour {
    RsSurface surface;
    RsReservoir reservoir;
    bool previous;   // its target uses last frame's lights
};

// Where to look; made by a stage (temporal, spatial), read back by its rsLoadNeighbour.
struct RsNeighbourhood {
    uvec2 pixel;     // temporal: of the previous frame
    float radius;    // pixels
    vec2 rotation;   // random numbers of this pixel
    uint count;
    uint accepted;   // bit i: neighbour i passed the surface tests; the others never existed
    float confidence;   // S
};

// Provided by the stage. `i` is a set bit of `accepted`.
RsNeighbour rsLoadNeighbour(RsNeighbourhood where, uint i);

RsPackedLight rsLightFor(RsNeighbour n, uint id) { return n.previous ? rsLoadPreviousLight(id) : rsLoadLight(id); }

// Running sum of a weighted reservoir (Chao 1982).
struct RsSelection {
    uint light;
    uint uv;
    uint age;
    float target;        // p^_c of the selected sample
    float sourceTarget;  // p^_s of it, s its source
    float sum;
    int source;          // -1: the canonical
};

void rsSelect(inout RsSelection selection, RsReservoir r, float weight, float target, float sourceTarget, int source,
              float coin) {
    if (!(weight > 0.0)) return;
    selection.sum += weight;
    if (coin * selection.sum >= weight) return;
    selection.light = r.light;
    selection.uv = r.uv;
    selection.age = rsAge(r);
    selection.target = target;
    selection.sourceTarget = sourceTarget;
    selection.source = source;
}

// Every neighbour's own sample, shifted here. None of it needs a ray.
void rsSelectNeighbours(inout RsSelection selection, RsSurface s, RsNeighbourhood where, float canonicalConfidence,
                        uint weights, inout RsRandom random) {
    for (uint i = 0u; i < where.count; ++i) {
        if ((where.accepted & (1u << i)) == 0u) continue;
        RsNeighbour n = rsLoadNeighbour(where, i);
        float coin = rsNext(random);
        if (!rsHasSample(n.reservoir)) continue;
        float here = rsDirect(s, rsLoadLight(n.reservoir.light), n.reservoir.uv).target;
        if (here <= 0.0) continue;
        float there = weights == RS_WEIGHTS_OFF || weights == RS_WEIGHTS_BASIC
                          ? 1.0
                          : rsDirect(n.surface, rsLightFor(n, n.reservoir.light), n.reservoir.uv).target;
        float c = float(rsConfidence(n.reservoir));
        float mis = c;
        if (weights == RS_WEIGHTS_PAIRWISE) {
            float total = canonicalConfidence * here + where.confidence * there;
            mis = there > 0.0 ? where.confidence / (where.confidence + canonicalConfidence) * c * there / total : 0.0;
        }
        rsSelect(selection, n.reservoir, mis * here * n.reservoir.ucw, here, there, int(i), coin);
    }
}

RsReservoir rsCombine(RsSurface s, RsReservoir canonical, RsNeighbourhood where, uint weights, bool traced,
                      inout RsRandom random) {
    float cc = float(rsConfidence(canonical)), S = where.confidence;
    if (where.accepted == 0u || S <= 0.0) return canonical;

    RsSelection selection = RsSelection(RS_NO_LIGHT, 0u, 0u, 0.0, 0.0, 0.0, -1);
    rsSelectNeighbours(selection, s, where, cc, weights, random);

    bool pairwise = weights == RS_WEIGHTS_PAIRWISE;
    float canonicalTarget =
        rsHasSample(canonical) ? rsDirect(s, rsLoadLight(canonical.light), canonical.uv).target : 0.0;
    float coin = rsNext(random);
    if (!pairwise) rsSelect(selection, canonical, cc * canonicalTarget * canonical.ucw, canonicalTarget, canonicalTarget, -1, coin);

    // How probable is one sample in each neighbour's domain? Pairwise asks for the canonical's sample, to weigh it;
    // the others for the selected one, to normalise it. The last round traces the selected sample from here.
    bool asksCanonical = pairwise && canonicalTarget > 0.0;
    float canonicalMis = 0.0;
    float normalisation = weights == RS_WEIGHTS_BALANCE ? cc * selection.target : cc;
    bool visible = true;
    for (uint i = 0u; i <= where.count; ++i) {
        bool last = i == where.count;
        if (!last && (where.accepted & (1u << i)) == 0u) continue;
        if (last && pairwise) {
            float mis = (canonicalMis * S + cc) / (S + cc);
            rsSelect(selection, canonical, mis * canonicalTarget * canonical.ucw, canonicalTarget, canonicalTarget, -1, coin);
        }
        bool asks = last ? traced && selection.source >= 0 && selection.sum > 0.0
                         : asksCanonical || (!pairwise && weights != RS_WEIGHTS_OFF && selection.sum > 0.0);
        RsNeighbour n;
        n.surface = s;
        n.previous = false;
        if (!last) n = rsLoadNeighbour(where, i);
        float c = last ? 0.0 : float(rsConfidence(n.reservoir));
        float there = 0.0;
        if (asks) {
            bool canonicalAsked = pairwise && !last;
            uint light = canonicalAsked ? canonical.light : selection.light;
            RsDirect direct = rsDirect(n.surface, rsLightFor(n, light), canonicalAsked ? canonical.uv : selection.uv);
            there = direct.target;
            bool own = !last && !pairwise && selection.source == int(i);
            if (traced && !own && there > 0.0 && !rsUnoccluded(n.surface, direct.incident)) there = 0.0;
        }
        if (last) visible = !asks || there > 0.0;
        else if (pairwise) canonicalMis += c / S * (asks ? cc * canonicalTarget / (cc * canonicalTarget + S * there) : 0.0);
        else normalisation += weights == RS_WEIGHTS_OFF ? c : weights == RS_WEIGHTS_BASIC ? (there > 0.0 ? c : 0.0) : c * there;
    }

    uint confidence = rsConfidence(canonical) + uint(S);
    if (!(selection.sum > 0.0) || !visible) return rsEmptyReservoir(confidence);
    float ucw = selection.sum / selection.target;
    if (weights == RS_WEIGHTS_BALANCE) ucw *= selection.sourceTarget / normalisation;
    else if (!pairwise) ucw /= normalisation;
    return rsMakeReservoir(selection.light, selection.uv, ucw, confidence, selection.age);
}

#endif
