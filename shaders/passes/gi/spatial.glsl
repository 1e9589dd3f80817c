#version 460
#extension GL_GOOGLE_include_directive : require
#define RS_PASS_RAYS
#define RS_PASS_INDIRECT
#include "passes/bindings.glsl"
#include "passes/gi_reservoirs.glsl"
#include "restir/di/spatial.glsl"

void main() {
    uvec2 pixel = rsPixelOn(rsFrame.gi.field);
    if (!rsInside(pixel)) return;
    RsSurface s = rsLoadSurface(pixel);
    RsReservoir canonical = rsLoadGiSource(pixel);
    RsRandom random = rsRandom(pixel, rsFrame.seed, RS_STAGE_GI + RS_STAGE_SPATIAL + rsPass.index);
    RsCombined combined = RsCombined(canonical, rsNoLight());
    if (s.valid) combined = rsDiSpatial(s, canonical, pixel, rsFrame.extent, rsFrame.gi, random);
    rsStoreGiReservoir(rsPass.target, rsIndex(pixel), combined.reservoir);
    if (rsPass.shades != 0u) rsShadeIndirect(pixel, rsWithOwn(pixel, s, combined.shading), random);
}
