#version 460
#extension GL_GOOGLE_include_directive : require
#define RS_PASS_RAYS
#define RS_PASS_INDIRECT
#include "passes/bindings.glsl"
#include "passes/gi_reservoirs.glsl"
#include "passes/back_project.glsl"
#include "restir/di/temporal.glsl"

void main() {
    uvec2 pixel = rsPixelOn(rsFrame.gi.field);
    if (!rsInside(pixel)) return;
    RsSurface s = rsLoadSurface(pixel);
    if (!s.valid) return;
    RsRandom random = rsRandom(pixel, rsFrame.seed, RS_STAGE_GI + RS_STAGE_TEMPORAL);
    RsGiReservoir fresh = rsLoadGiReservoir(rsPass.target, rsIndex(pixel));
    rsStoreGiReservoir(rsPass.target, rsIndex(pixel), rsDiTemporal(s, fresh, rsBackProject(pixel, s), rsFrame.gi, random));
}
