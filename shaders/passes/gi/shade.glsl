#version 460
#extension GL_GOOGLE_include_directive : require
#define RS_PASS_RAYS
#define RS_PASS_INDIRECT
#include "passes/bindings.glsl"
#include "passes/gi_reservoirs.glsl"
#include "restir/di/shade.glsl"

void main() {
    uvec2 pixel = rsPixelOn(rsFrame.gi.field);
    if (!rsInside(pixel)) return;
    uint i = rsIndex(pixel);
    RsSurface s = rsLoadSurface(pixel);
    RsReservoir r = rsLoadGiReservoir(rsPass.target, i);
    RsRandom random = rsRandom(pixel, rsFrame.seed, RS_STAGE_GI + RS_STAGE_SHADE);
    bool occluded = false;
    RsShading shading = rsNoLight();
    if (s.valid) shading = rsDiShade(s, r, rsFrame.gi.visibility, occluded);
    if (occluded) rsStoreGiReservoir(rsPass.target, i, rsEmptyGiReservoir(rsConfidence(r)));
    rsShadeIndirect(pixel, rsWithOwn(pixel, s, shading), random);
}
