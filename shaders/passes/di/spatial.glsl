#version 460
#extension GL_GOOGLE_include_directive : require
#define RS_PASS_RAYS
#include "passes/bindings.glsl"
#include "passes/output.glsl"
#include "restir/di/spatial.glsl"

void main() {
    uvec2 pixel = rsPixel();
    if (!rsInside(pixel)) return;
    RsSurface s = rsLoadSurface(pixel);
    RsReservoir canonical = rsLoadSource(pixel);
    RsRandom random = rsRandom(pixel, rsFrame.seed, RS_STAGE_SPATIAL + rsPass.index);
    RsCombined combined = RsCombined(canonical, rsNoLight());
    if (s.valid) combined = rsDiSpatial(s, canonical, pixel, rsFrame.extent, rsFrame.di, random);
    rsReservoirs[rsPass.target].at[rsIndex(pixel)] = combined.reservoir;
    if (rsPass.shades != 0u) rsWriteOutputs(pixel, combined.shading);
}
