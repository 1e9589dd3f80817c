#version 460
#extension GL_GOOGLE_include_directive : require
#define RS_PASS_RAYS
#include "passes/bindings.glsl"
#include "passes/back_project.glsl"
#include "restir/di/temporal.glsl"

void main() {
    uvec2 pixel = rsPixel();
    if (!rsInside(pixel)) return;
    RsSurface s = rsLoadSurface(pixel);
    if (!s.valid) return;
    RsRandom random = rsRandom(pixel, rsFrame.seed, RS_STAGE_TEMPORAL);
    RsReservoir fresh = rsReservoirs[rsPass.target].at[rsIndex(pixel)];
    rsReservoirs[rsPass.target].at[rsIndex(pixel)] =
        rsDiTemporal(s, fresh, rsBackProject(pixel, s), rsFrame.di, random);
}
