#version 460
#extension GL_GOOGLE_include_directive : require
#define RS_PASS_RAYS
#include "passes/bindings.glsl"
#include "passes/reproject.glsl"
#include "restir/di/temporal.glsl"

void main() {
    if (!rsInside()) return;
    uvec2 pixel = gl_GlobalInvocationID.xy;
    RsSurface s = rsLoadSurface(pixel);
    if (!s.valid) return;
    float expectedDepth = rsDepthOf(rsFrame.previousView, s.position);
    vec2 previousPixel = rsPreviousPixel(pixel, s);
    RsRandom random = rsRandom(pixel, rsFrame.seed, RS_STAGE_TEMPORAL);
    RsReservoir fresh = rsReservoirs[rsPass.target].at[rsIndex(pixel)];
    rsReservoirs[rsPass.target].at[rsIndex(pixel)] =
        rsDiTemporal(s, fresh, previousPixel, expectedDepth, rsFrame.previousExtent, rsFrame.di, random);
}
