#version 460
#extension GL_GOOGLE_include_directive : require
#define RS_PASS_RAYS
#include "passes/bindings.glsl"
#include "passes/back_project.glsl"
#include "passes/output.glsl"
#include "restir/di/spatiotemporal.glsl"

void main() {
    uvec2 pixel = rsPixel();
    if (!rsInside(pixel)) return;
    uint i = rsIndex(pixel);
    RsSurface s = rsLoadSurface(pixel);
    RsReservoir fresh = rsReservoirs[rsPass.target].at[i];
    RsRandom random = rsRandom(pixel, rsFrame.seed, RS_STAGE_TEMPORAL);   // instead of that stage
    RsCombined combined = RsCombined(fresh, rsNoLight());
    if (s.valid) combined = rsDiSpatiotemporal(s, fresh, rsBackProject(pixel, s), rsFrame.di, random);
    rsReservoirs[rsPass.target].at[i] = combined.reservoir;
    if (rsPass.shades != 0u) rsWriteOutputs(pixel, combined.shading);
}
