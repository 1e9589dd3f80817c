#version 460
#extension GL_GOOGLE_include_directive : require
#define RS_PASS_RAYS
#define RS_PASS_INDIRECT
#include "passes/bindings.glsl"
#include "passes/gi_reservoirs.glsl"
#include "passes/notes.glsl"
#include "restir/di/pair_targets.glsl"

void main() {
    uvec2 pixel = rsPixelOn(rsFrame.gi.field);
    if (!rsInside(pixel)) return;
    RsPairing pairing = RsPairing(pixel, rsFrame.extent, rsFrame.seed, RS_STAGE_GI + RS_STAGE_SPATIAL + rsPass.index);
    rsDiPairTargets(rsLoadSurface(pixel), pairing, rsFrame.gi);
}
