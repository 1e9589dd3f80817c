#version 460
#extension GL_GOOGLE_include_directive : require
#define RS_PASS_RAYS
#include "passes/bindings.glsl"
#include "passes/output.glsl"
#include "restir/di/next_event.glsl"

void main() {
    if (!rsInside()) return;
    uvec2 pixel = gl_GlobalInvocationID.xy;
    RsSurface s = rsLoadSurface(pixel);
    RsRandom random = rsRandom(pixel, rsFrame.seed, RS_STAGE_CANDIDATES);
    RsShading shading = rsNoLight();
    if (s.valid) shading = rsDiNextEvent(s, rsFrame.lightCount, rsFrame.di.lightCandidates, random);
    rsWriteOutputs(pixel, shading);
}
