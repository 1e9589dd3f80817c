#version 460
#extension GL_GOOGLE_include_directive : require
#define RS_PASS_RAYS
#include "passes/bindings.glsl"
#include "passes/notes.glsl"
#include "restir/di/pair_targets.glsl"

void main() {
    if (!rsInside()) return;
    uvec2 pixel = gl_GlobalInvocationID.xy;
    RsPairing pairing = RsPairing(pixel, rsFrame.extent, rsFrame.seed, RS_STAGE_SPATIAL + rsPass.index);
    rsDiPairTargets(rsLoadSurface(pixel), pairing, rsFrame.di);
}
