#version 460
#extension GL_GOOGLE_include_directive : require
#define RS_PASS_RAYS
#include "passes/bindings.glsl"
#include "passes/output.glsl"
#include "restir/di/shade.glsl"

void main() {
    uvec2 pixel = rsPixel();
    if (!rsInside(pixel)) return;
    uint i = rsIndex(pixel);
    RsSurface s = rsLoadSurface(pixel);
    RsReservoir r = rsReservoirs[rsPass.target].at[i];
    bool occluded = false;
    RsShading shading = rsNoLight();
    if (s.valid) shading = rsDiShade(s, r, rsFrame.di.visibility, occluded);
    if (occluded && rsFrame.di.visibility == RS_VISIBILITY_CACHED)
        rsReservoirs[rsPass.target].at[i] = rsEmptyReservoir(rsConfidence(r));
    rsWriteOutputs(pixel, shading);
}
