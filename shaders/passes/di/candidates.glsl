#version 460
#extension GL_GOOGLE_include_directive : require
#define RS_PASS_RAYS
#include "passes/bindings.glsl"
#include "restir/di/candidates.glsl"

void main() {
    uvec2 pixel = rsPixel();
    if (!rsInside(pixel)) return;
    RsSurface s = rsLoadSurface(pixel);
    RsRandom random = rsRandom(pixel, rsFrame.seed, RS_STAGE_CANDIDATES);
    rsReservoirs[rsPass.target].at[rsIndex(pixel)] =
        s.valid ? rsDiCandidates(s, rsFrame.lightCount, rsFrame.di, random) : rsEmptyReservoir(0u);
}
