#version 460
#extension GL_GOOGLE_include_directive : require
#define RS_PASS_RAYS
#define RS_PASS_HITS
#include "passes/bindings.glsl"
#include "restir/gi/candidates.glsl"
#include "passes/gi_reservoirs.glsl"

void main() {
    uvec2 pixel = rsPixelOn(RS_FIELD_ALL);
    if (!rsInside(pixel)) return;
    RsSurface s = rsLoadSurface(pixel);
    RsRandom random = rsRandom(pixel, rsFrame.seed, RS_STAGE_GI + RS_STAGE_CANDIDATES);
    RsGiFresh fresh = RsGiFresh(rsEmptyGiReservoir(0u), vec3(0.0), vec3(0.0));
    if (s.valid) fresh = rsGiCandidate(s, rsFrame.lightCount, rsFrame.giBounces, rsFrame.gi.lightCandidates, random);
    bool alone = rsPass.shades != 0u;   // nothing is reused
    rsAddIndirect(pixel, alone ? fresh.steady + fresh.rest : fresh.rest, random);
    if (!alone) rsStoreGiReservoir(rsPass.target, rsIndex(pixel), fresh.reservoir);
}
