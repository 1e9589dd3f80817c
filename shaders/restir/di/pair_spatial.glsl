// Paired spatial reuse, second half: the pairwise weights of restir/di/combine.glsl from what this pixel and its partners
// noted. No ray, no surface but its own, and a target only to shade with.
#ifndef RESTIR_DI_PAIR_SPATIAL_GLSL
#define RESTIR_DI_PAIR_SPATIAL_GLSL
#include "restir/di/combine.glsl"
#include "restir/di/partner.glsl"

RsReservoir rsLoadSource(uvec2 pixel);
uint rsLoadNote(uvec2 pixel, uint number);   // see restir/di/pair_targets.glsl

struct RsPair {
    bool exists;
    uvec2 partner;
    float here;    // target of the partner's sample in this pixel
    float there;   // and of this pixel's in the partner
};

RsPair rsLoadPair(uvec2 pixel, uint i, uint seed, uint stage, RsDiConstants di) {
    RsPair pair = RsPair(false, uvec2(0u), 0.0, 0.0);
    uint here = rsLoadNote(pixel, 1u + i);
    if (here == RS_NO_PARTNER) return pair;
    pair.partner = uvec2(rsPartnerPixel(pixel, rsPartnerKey(seed, stage, i), di));
    uint there = rsLoadNote(pair.partner, 1u + i);
    pair.exists = there != RS_NO_PARTNER;   // both must have said so, though they asked the same
    pair.here = rsUnpackTarget(here);
    pair.there = rsUnpackTarget(there);
    return pair;
}

// `shades`: also the mean of all inputs.
RsCombined rsDiPairSpatial(RsSurface s, RsReservoir canonical, uvec2 pixel, uint seed, uint stage, bool shades,
                           RsDiConstants di) {
    float cc = float(rsConfidence(canonical)), S = 0.0;
    for (uint i = 0u; i < di.neighbours; ++i) {
        RsPair pair = rsLoadPair(pixel, i, seed, stage, di);
        if (pair.exists) S += float(rsConfidence(rsLoadSource(pair.partner)));
    }
    RsShading shading = rsNoLight();
    RsDirect ownDirect;
    ownDirect.target = 0.0;
    ownDirect.integrand = vec3(0.0);
    if (shades && rsHasSample(canonical)) ownDirect = rsEvaluate(s, canonical, false);
    if (S <= 0.0) {
        rsAddLight(shading, s, ownDirect, canonical.ucw);
        return RsCombined(canonical, shading);
    }

    RsRandom random = rsRandom(pixel, seed, stage);
    RsSelection selection = RsSelection(rsEmptyReservoir(0u), 0.0, 0.0, 0.0, -1);
    float own = rsUnpackTarget(rsLoadNote(pixel, 0u));
    float share = rsPairwiseShare(di.weights, cc, S), canonicalMis = 0.0;
    for (uint i = 0u; i < di.neighbours; ++i) {
        RsPair pair = rsLoadPair(pixel, i, seed, stage, di);
        if (!pair.exists) continue;
        RsReservoir r = rsLoadSource(pair.partner);
        float c = float(rsConfidence(r)), coin = rsNext(random);
        if (own > 0.0) canonicalMis += c / S * cc * own / (cc * own + S * pair.there);
        if (!(rsHasSample(r) && pair.here > 0.0)) continue;
        float theirs = rsUnpackTarget(rsLoadNote(pair.partner, 0u));
        float mis = share * c * theirs / (cc * pair.here + S * theirs);
        if (shades) rsAddLight(shading, s, rsEvaluate(s, r, false), mis * r.ucw);
        rsSelect(selection, r, mis * pair.here * r.ucw, pair.here, theirs, int(i), coin);
    }
    float mis = own > 0.0 ? canonicalMis * share + 1.0 - share : 0.0;
    rsAddLight(shading, s, ownDirect, mis * canonical.ucw);
    rsSelect(selection, canonical, mis * own * canonical.ucw, own, own, -1, rsNext(random));

    uint confidence = rsConfidence(canonical) + uint(S);
    if (!(selection.sum > 0.0)) return RsCombined(rsEmptyReservoir(confidence), shading);
    float ucw = selection.sum / selection.target;
    return RsCombined(rsKeep(selection.kept, ucw, confidence), shading);
}

#endif
