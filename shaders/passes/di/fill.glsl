#version 460
#extension GL_GOOGLE_include_directive : require
#define RS_PASS_RAYS
#include "passes/bindings.glsl"
#include "passes/output.glsl"
#include "restir/di/fill.glsl"

void main() {
    uvec2 pixel = rsPixelOn(rsOtherField(rsFrame.di.field));
    if (!rsInside(pixel)) return;
    RsSurface s = rsLoadSurface(pixel);
    RsRandom random = rsRandom(pixel, rsFrame.seed, RS_STAGE_FILL);
    RsShading shading = rsNoLight();
    bool distances = (rsFrame.flags & (RS_FRAME_DIFFUSE | RS_FRAME_SPECULAR)) != 0u;
    if (s.valid) shading = rsDiFill(s, pixel, rsFrame.extent, rsFrame.lightCount, distances, rsFrame.di, random);
    rsWriteOutputs(pixel, shading);
}
