#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/bindings.glsl"
#include "passes/notes.glsl"
#include "passes/output.glsl"
#include "restir/di/pair_spatial.glsl"

void main() {
    uvec2 pixel = rsPixel();
    if (!rsInside(pixel)) return;
    RsSurface s = rsLoadSurface(pixel);
    RsReservoir canonical = rsLoadSource(pixel);
    bool shades = rsPass.shades != 0u;
    RsCombined combined = RsCombined(canonical, rsNoLight());
    if (s.valid)
        combined = rsDiPairSpatial(s, canonical, pixel, rsFrame.seed, RS_STAGE_SPATIAL + rsPass.index, shades, rsFrame.di);
    rsReservoirs[rsPass.target].at[rsIndex(pixel)] = combined.reservoir;
    if (shades) rsWriteOutputs(pixel, combined.shading);
}
