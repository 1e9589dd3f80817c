#version 460
#extension GL_GOOGLE_include_directive : require
#define RS_PASS_RAYS
#define RS_PASS_HITS
#define RS_PASS_INDIRECT
#define RS_PASS_OWN
#include "passes/bindings.glsl"
#include "restir/gi/candidates.glsl"
#include "passes/gi_reservoirs.glsl"

void main() {
    uvec2 pixel = rsPixelOn(rsFrame.gi.field);
    if (!rsInside(pixel)) return;
    RsSurface s = rsLoadSurface(pixel);
    RsRandom random = rsRandom(pixel, rsFrame.seed, RS_STAGE_GI + RS_STAGE_CANDIDATES);
    RsGiFresh fresh = RsGiFresh(rsEmptyGiReservoir(0u), rsNoLight(), 0.0);
    RsLightSource source = RsLightSource(rsFrame.lightCount, rsFrame.gi.treeShare);
    if (s.valid) fresh = rsGiCandidate(s, source, rsFrame.giBounces, rsFrame.gi.lightCandidates, random);
    if (rsPass.shades != 0u) rsShadeIndirect(pixel, fresh.shading, random);   // nothing is reused
    else {
        rsStoreGiReservoir(rsPass.target, rsIndex(pixel), fresh.reservoir);
        rsShadeOwn(pixel, s, fresh.shading, random);
    }
}
