#version 460
#extension GL_GOOGLE_include_directive : require
#define RS_PASS_RAYS
#include "passes/bindings.glsl"
#include "passes/output.glsl"
#include "restir/di/next_event.glsl"

void main() {
    uvec2 pixel = rsPixel();
    if (!rsInside(pixel)) return;
    RsSurface s = rsLoadSurface(pixel);
    RsRandom random = rsRandom(pixel, rsFrame.seed, RS_STAGE_CANDIDATES);
    RsShading shading = rsNoLight();
    if (s.valid) shading = rsDiNextEvent(s, rsFrame.lightCount, rsFrame.di.lightCandidates, random);
    rsWriteOutputs(pixel, shading);
}
