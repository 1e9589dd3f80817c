// GRIS over a canonical reservoir and up to 16 neighbours (Lin et al. 2022), with the weights of Settings::weights:
//   Off       m_i = c_i / sum c
//   Basic     m_i = c_i [p^_i(y) > 0] / sum c_j [p^_j(y) > 0]          (O(k): normalised at the selected sample)
//   Balance   m_i = c_i p^_i(y) / sum c_j p^_j(y)                      (likewise)
//   Pairwise  Bitterli 2022, defensive: with S = sum of the neighbours' c
//             m_i = S/(S+c_c) c_i p^_i / (c_c p^_c + S p^_i)
//             m_c = S/(S+c_c) sum (c_i/S) c_c p^_c / (c_c p^_c + S p^_i) + c_c/(S+c_c)
// The shift is the identity on the light with |J| = 1 (restir/lights/light.glsl). With RS_VISIBILITY_TRACED every target
// contains its pixel's V: 1 for a reservoir's own sample, since that reservoir is visibility-limited, a ray for any other.
// Nothing here but p^ and W depends on what was sampled: acceptance, confidences and S come from surfaces and counts.
//
// Besides the reservoir comes the mean of all inputs, sum m_i f(Y_i) V W_i: as unbiased as shading the selected sample,
// with less noise in colour and shadow. Off and Pairwise know their m_i; Basic and Balance normalise at one sample only.
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

struct RsCombined {
    RsReservoir reservoir;
    vec3 radiance;   // sum m_i f(Y_i) V W_i; without meaning for Basic and Balance
};

// V of a sample from a surface, where weights ask for it.
bool rsVisibleFor(bool traced, RsSurface s, RsDirect direct) { return !traced || rsUnoccluded(s, direct.incident); }

// Every neighbour's own sample, shifted here.
void rsSelectNeighbours(inout RsSelection selection, inout vec3 radiance, RsSurface s, RsNeighbourhood where,
                        float canonicalConfidence, uint weights, bool traced, inout RsRandom random) {
    for (uint i = 0u; i < where.count; ++i) {
        if ((where.accepted & (1u << i)) == 0u) continue;
        RsNeighbour n = rsLoadNeighbour(where, i);
        float coin = rsNext(random);
        if (!rsHasSample(n.reservoir)) continue;
        RsDirect here = rsDirect(s, rsLoadLight(n.reservoir.light), n.reservoir.uv);
        if (here.target <= 0.0 || !rsVisibleFor(traced, s, here)) continue;
        bool asksThere = weights == RS_WEIGHTS_BALANCE || weights == RS_WEIGHTS_PAIRWISE;
        float there = asksThere ? rsDirect(n.surface, rsLightFor(n, n.reservoir.light), n.reservoir.uv).target : 1.0;
        float mis = float(rsConfidence(n.reservoir));
        if (weights == RS_WEIGHTS_PAIRWISE) {
            float S = where.confidence;
            float total = canonicalConfidence * here.target + S * there;
            mis *= S / (S + canonicalConfidence) * there / total;
        }
        radiance += mis * n.reservoir.ucw * here.integrand;
        rsSelect(selection, n.reservoir, mis * here.target * n.reservoir.ucw, here.target, there, int(i), coin);
    }
}

RsCombined rsCombine(RsSurface s, RsReservoir canonical, RsNeighbourhood where, uint weights, bool traced,
                     inout RsRandom random) {
    float cc = float(rsConfidence(canonical)), S = where.confidence;
    RsDirect own;
    own.target = 0.0;
    own.integrand = vec3(0.0);
    if (rsHasSample(canonical)) own = rsDirect(s, rsLoadLight(canonical.light), canonical.uv);
    if (where.accepted == 0u || S <= 0.0) return RsCombined(canonical, own.integrand * canonical.ucw);

    bool pairwise = weights == RS_WEIGHTS_PAIRWISE;
    RsSelection selection = RsSelection(RS_NO_LIGHT, 0u, 0u, 0.0, 0.0, 0.0, -1);
    vec3 radiance = vec3(0.0);
    rsSelectNeighbours(selection, radiance, s, where, cc, weights, traced, random);
    float coin = rsNext(random);
    if (!pairwise) rsSelect(selection, canonical, cc * own.target * canonical.ucw, own.target, own.target, -1, coin);

    // How probable is one sample in each neighbour's domain? Pairwise asks for the canonical's sample, to weigh it;
    // the others for the selected one, to normalise it.
    bool asks = pairwise ? own.target > 0.0 : weights != RS_WEIGHTS_OFF && selection.sum > 0.0;
    uint askedLight = pairwise ? canonical.light : selection.light;
    uint askedUv = pairwise ? canonical.uv : selection.uv;
    float canonicalMis = 0.0;
    float normalisation = weights == RS_WEIGHTS_BALANCE ? cc * selection.target : cc;
    for (uint i = 0u; asks && i < where.count; ++i) {
        if ((where.accepted & (1u << i)) == 0u) continue;
        RsNeighbour n = rsLoadNeighbour(where, i);
        float c = float(rsConfidence(n.reservoir));
        RsDirect direct = rsDirect(n.surface, rsLightFor(n, askedLight), askedUv);
        bool itsOwn = !pairwise && selection.source == int(i);
        float there = direct.target;
        if (there > 0.0 && !itsOwn && !rsVisibleFor(traced, n.surface, direct)) there = 0.0;
        if (pairwise) canonicalMis += c / S * cc * own.target / (cc * own.target + S * there);
        else normalisation += weights == RS_WEIGHTS_BALANCE ? c * there : there > 0.0 ? c : 0.0;
    }

    if (pairwise) {
        float mis = (canonicalMis * S + cc) / (S + cc);
        radiance += mis * canonical.ucw * own.integrand;
        rsSelect(selection, canonical, mis * own.target * canonical.ucw, own.target, own.target, -1, coin);
    } else if (weights == RS_WEIGHTS_OFF) {
        normalisation = cc + S;
        radiance = (radiance + cc * canonical.ucw * own.integrand) / normalisation;
    }
    uint confidence = rsConfidence(canonical) + uint(S);
    if (!(selection.sum > 0.0)) return RsCombined(rsEmptyReservoir(confidence), radiance);
    float ucw = selection.sum / selection.target;
    if (weights == RS_WEIGHTS_BALANCE) ucw *= selection.sourceTarget / normalisation;
    else if (!pairwise) ucw /= normalisation;
    return RsCombined(rsMakeReservoir(selection.light, selection.uv, ucw, confidence, selection.age), radiance);
}

#endif
