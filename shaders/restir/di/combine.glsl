// GRIS over a canonical reservoir and up to 16 neighbours (Lin et al. 2022), with the weights of Settings::weights:
//   Off       m_i = c_i / sum c
//   Basic     m_i = c_i [p^_i(y) > 0] / sum c_j [p^_j(y) > 0]          (O(k): normalised at the selected sample)
//   Balance   m_i = c_i p^_i(y) / sum c_j p^_j(y)                      (likewise)
//   PairwisePlain   Bitterli 2022: with S = sum of the neighbours' c
//             m_i = c_i p^_i / (c_c p^_c + S p^_i)
//             m_c = sum (c_i/S) c_c p^_c / (c_c p^_c + S p^_i)
//   Pairwise  the same, defensive: all times S/(S+c_c), and m_c + c_c/(S+c_c)
// The shift is the identity on the light with |J| = 1 (restir/lights/light.glsl). With RS_VISIBILITY_TRACED every target
// contains its pixel's V: 1 for a reservoir's own sample, since that reservoir is visibility-limited, a ray for any other.
// Nothing here but p^ and W depends on what was sampled: acceptance, confidences and S come from surfaces and counts.
//
// Besides the reservoir comes the mean of all inputs, sum m_i f(Y_i) V W_i: as unbiased as shading the selected sample,
// with less noise in colour and shadow. Off and Pairwise know their m_i; Basic and Balance normalise at one sample only.
#ifndef RESTIR_DI_COMBINE_GLSL
#define RESTIR_DI_COMBINE_GLSL
#include "restir/di/sample.glsl"

// One domain to take a sample from.
struct RsNeighbour {
    RsSurface surface;
    RsReservoir reservoir;
    bool previous;   // its target uses last frame's lights and scene
};

// Where to look; made by a stage (temporal, spatial, spatiotemporal), read back by its rsLoadNeighbour.
struct RsNeighbourhood {
    uvec2 pixel;     // temporal: of the previous frame
    uint field;      // of the pixels that have reservoirs
    float radius;    // pixels
    vec2 rotation;   // random numbers of this pixel
    uint count;
    uint accepted;   // bit i: neighbour i passed the surface tests; the others never existed
    float confidence;   // S
};

// Provided by the stage. `i` is a set bit of `accepted`.
RsNeighbour rsLoadNeighbour(RsNeighbourhood where, uint i);

// Running sum of a weighted reservoir (Chao 1982).
struct RsSelection {
    RsReservoir kept;
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
    selection.kept = r;
    selection.target = target;
    selection.sourceTarget = sourceTarget;
    selection.source = source;
}

struct RsCombined {
    RsReservoir reservoir;
    RsShading shading;   // sum m_i f(Y_i) V W_i; without meaning for Basic and Balance
};

// Sums of a combination while it runs.
struct RsCombination {
    RsSelection selection;
    RsShading shading;
    float canonicalMis;    // Pairwise: m_c before the defensive part
    float normalisation;   // Basic, Balance: at the selected sample
};

bool rsIsPairwise(uint weights) { return weights >= RS_WEIGHTS_PAIRWISE; }
// What the pairs share; the canonical has the rest for itself.
float rsPairwiseShare(uint weights, float canonicalConfidence, float S) {
    return weights == RS_WEIGHTS_PAIRWISE ? S / (S + canonicalConfidence) : 1.0;
}

// Neighbour `i`'s own sample, shifted to `s` and visible: `here` is f and p^_c.
void rsTakeSample(inout RsCombination sums, RsSurface s, RsNeighbour n, RsDirect here, int i, float canonicalConfidence, float S,
                  uint weights, float coin) {
    bool asksThere = weights == RS_WEIGHTS_BALANCE || rsIsPairwise(weights);
    float there = asksThere ? rsEvaluate(n.surface, n.reservoir, n.previous).target : 1.0;
    float mis = float(rsConfidence(n.reservoir));
    if (rsIsPairwise(weights))
        mis *= rsPairwiseShare(weights, canonicalConfidence, S) * there / (canonicalConfidence * here.target + S * there);
    rsAddLight(sums.shading, s, here, mis * n.reservoir.ucw);
    rsSelect(sums.selection, n.reservoir, mis * here.target * n.reservoir.ucw, here.target, there, i, coin);
}

// Each neighbour is asked twice. First for its sample. Then how probable one sample is in its domain: Pairwise asks for
// the canonical's, to weigh it; Basic and Balance for the selected one, to normalise it. A pixel skips ahead to its next
// question that has an answer, so that pixels traced together wait for rays, not for one another's neighbours.
RsCombined rsCombine(RsSurface s, RsReservoir canonical, RsNeighbourhood where, uint weights, bool traced,
                     inout RsRandom random) {
    float cc = float(rsConfidence(canonical)), S = where.confidence;
    RsDirect own;
    own.target = 0.0;
    own.integrand = vec3(0.0);
    if (rsHasSample(canonical)) own = rsEvaluate(s, canonical, false);
    RsShading alone = rsNoLight();
    if (where.accepted == 0u || S <= 0.0) {
        rsAddLight(alone, s, own, canonical.ucw);
        return RsCombined(canonical, alone);
    }

    bool pairwise = rsIsPairwise(weights), balance = weights == RS_WEIGHTS_BALANCE;
    RsCombination sums =
        RsCombination(RsSelection(rsEmptyReservoir(0u), 0.0, 0.0, 0.0, -1), alone, 0.0, 0.0);
    bool asks = rsHasSample(canonical);   // whether neighbours are asked for a sample that is not theirs
    float coin = 0.0;
    for (uint question = 0u; question < 2u * where.count;) {
        bool found = false, sampling = true;
        uint i = 0u;
        RsNeighbour n;
        while (!found && question < 2u * where.count) {
            sampling = question < where.count;
            i = sampling ? question : question - where.count;
            if (question == where.count && !pairwise) {
                float ownWeight = cc * own.target * canonical.ucw;
                rsSelect(sums.selection, canonical, ownWeight, own.target, own.target, -1, rsNext(random));
                asks = weights != RS_WEIGHTS_OFF && sums.selection.sum > 0.0;
                sums.normalisation = balance ? cc * sums.selection.target : cc;
            }
            ++question;
            if ((where.accepted & (1u << i)) == 0u) continue;
            n = rsLoadNeighbour(where, i);
            if (sampling) coin = rsNext(random);
            found = asks;
            if (sampling) found = rsHasSample(n.reservoir);
        }
        if (!found) break;

        RsSurface at = s;
        RsReservoir sampled = n.reservoir;
        if (!sampling) {
            at = n.surface;
            sampled = canonical;
            if (!pairwise) sampled = sums.selection.kept;
        }
        bool previous = n.previous && !sampling;
        RsDirect direct = rsEvaluate(at, sampled, previous);
        bool itsOwn = !sampling && !pairwise && sums.selection.source == int(i);
        bool counts = direct.target > 0.0;
        if (counts && traced && !itsOwn) counts = rsIsSeen(at, sampled, direct.incident, previous);

        float c = float(rsConfidence(n.reservoir));
        float there = counts ? direct.target : 0.0;
        if (sampling) {
            if (counts) rsTakeSample(sums, s, n, direct, int(i), cc, S, weights, coin);
        } else if (pairwise) {
            sums.canonicalMis += c / S * cc * own.target / (cc * own.target + S * there);
        } else {
            sums.normalisation += balance ? c * there : counts ? c : 0.0;
        }
    }

    if (pairwise) {
        float share = rsPairwiseShare(weights, cc, S);
        float mis = own.target > 0.0 ? sums.canonicalMis * share + 1.0 - share : 0.0;
        rsAddLight(sums.shading, s, own, mis * canonical.ucw);
        rsSelect(sums.selection, canonical, mis * own.target * canonical.ucw, own.target, own.target, -1, rsNext(random));
    } else if (weights == RS_WEIGHTS_OFF) {
        sums.normalisation = cc + S;
        rsAddLight(sums.shading, s, own, cc * canonical.ucw);
        sums.shading = rsScale(sums.shading, 1.0 / sums.normalisation);
    }
    RsSelection selected = sums.selection;
    uint confidence = rsConfidence(canonical) + uint(S);
    if (!(selected.sum > 0.0)) return RsCombined(rsEmptyReservoir(confidence), sums.shading);
    float ucw = selected.sum / selected.target;
    if (balance) ucw *= selected.sourceTarget / sums.normalisation;
    else if (!pairwise) ucw /= sums.normalisation;
    return RsCombined(rsKeep(selected.kept, ucw, confidence), sums.shading);
}

#endif
