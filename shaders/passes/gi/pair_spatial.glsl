#version 460
#extension GL_GOOGLE_include_directive : require
#define RS_PASS_INDIRECT
#include "passes/bindings.glsl"
#include "passes/gi_reservoirs.glsl"
#include "passes/notes.glsl"
#include "restir/di/pair_spatial.glsl"

void main() {
    uvec2 pixel = rsPixelOn(rsFrame.gi.field);
    if (!rsInside(pixel)) return;
    RsSurface s = rsLoadSurface(pixel);
    RsReservoir canonical = rsLoadGiSource(pixel);
    uint stage = RS_STAGE_GI + RS_STAGE_SPATIAL + rsPass.index;
    bool shades = rsPass.shades != 0u;
    RsCombined combined = RsCombined(canonical, rsNoLight());
    if (s.valid) combined = rsDiPairSpatial(s, canonical, pixel, rsFrame.seed, stage, shades, rsFrame.gi);
    rsStoreGiReservoir(rsPass.target, rsIndex(pixel), combined.reservoir);
    if (!shades) return;
    RsRandom random = rsRandom(pixel, rsFrame.seed, stage + RS_STAGE_OWN_LIGHT);
    rsShadeIndirect(pixel, rsWithOwn(pixel, s, combined.shading), random);
}
