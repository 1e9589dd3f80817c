// Paired spatial reuse, first half: the target of each partner's sample here, with RS_VISIBILITY_TRACED a ray each. The
// second half reads the same of the partner instead of tracing it, which is half of the rays and targets.
#ifndef RESTIR_DI_PAIR_TARGETS_GLSL
#define RESTIR_DI_PAIR_TARGETS_GLSL
#include "restir/di/partner.glsl"
#include "restir/di/sample.glsl"
#include "restir/di/similar.glsl"

RsSurface rsLoadSurface(uvec2 pixel);
RsReservoir rsLoadSource(uvec2 pixel);
// Number 0 is the target of the pixel's own sample, 1 + i that of its i-th partner's. Numbers come in order; the last one
// may come again.
void rsStoreNote(uvec2 pixel, uint number, uint note);

struct RsPairing {
    uvec2 pixel;
    uvec2 extent;
    uint seed, stage;
};

// Whether `at` is inside and on the same surface, whichever of the two asks.
bool rsArePartners(RsSurface s, ivec2 at, uvec2 extent, RsDiConstants di) {
    if (!s.valid || !rsIsInside(at, extent)) return false;
    RsSurface other = rsLoadSurface(uvec2(at));
    return rsCompareInFrame(s, other, di) == RS_ACCEPTED && rsCompareInFrame(other, s, di) == RS_ACCEPTED;
}

// Note `number` as if nothing were occluded, and what it is the target of.
uint rsUnoccludedNote(RsSurface s, RsPairing pairing, uint number, RsDiConstants di, out RsDirect direct) {
    ivec2 at = ivec2(pairing.pixel);
    bool exists = s.valid;
    if (number > 0u) {
        at = rsPartnerPixel(pairing.pixel, rsPartnerKey(pairing.seed, pairing.stage, number - 1u), di);
        exists = rsArePartners(s, at, pairing.extent, di);
    }
    if (!exists) return RS_NO_PARTNER;
    RsReservoir r = rsLoadSource(uvec2(at));
    if (!rsHasSample(r)) return 0u;
    direct = rsEvaluate(s, r, false);
    return rsPackTarget(direct.target);
}

// The pixel's own sample needs no ray: it was killed if it is occluded. A pixel skips ahead to its next ray, so that
// pixels traced together wait for rays, not for one another's partners.
void rsDiPairTargets(RsSurface s, RsPairing pairing, RsDiConstants di) {
    bool traced = di.visibility == RS_VISIBILITY_TRACED;
    for (uint number = 0u; number <= di.neighbours;) {
        bool asks = false;
        RsDirect direct;
        for (; !asks && number <= di.neighbours; ++number) {
            uint note = rsUnoccludedNote(s, pairing, number, di, direct);
            rsStoreNote(pairing.pixel, number, note);
            asks = traced && number > 0u && note != RS_NO_PARTNER && note != 0u;
        }
        if (asks && !rsUnoccluded(s, direct.incident)) rsStoreNote(pairing.pixel, number - 1u, 0u);
    }
}

#endif
