#version 460
#extension GL_GOOGLE_include_directive : require
#define RS_PASS_RAYS
#include "passes/bindings.glsl"
#include "restir/di/temporal.glsl"

void main() {
    if (!rsInside()) return;
    uvec2 pixel = gl_GlobalInvocationID.xy;
    RsSurface s = rsLoadSurface(pixel);
    if (!s.valid) return;
    float expectedDepth = rsDepthOf(rsFrame.previousView, s.position);
    vec2 previousPixel = rsPixelOf(rsFrame.previousView, rsFrame.previousExtent, s.position);
    if ((rsFrame.flags & RS_FRAME_MOTION) != 0u) {
        vec2 motion = unpackHalf2x16(rsSurfacesFrame[rsIndex(pixel)].x);
        vec2 at = (vec2(pixel) + 0.5 + motion) / vec2(rsFrame.extent) - 0.5 * rsFrame.view.jitter;
        previousPixel = (at + 0.5 * rsFrame.previousView.jitter) * vec2(rsFrame.previousExtent);
    }
    RsRandom random = rsRandom(pixel, rsFrame.seed, RS_STAGE_TEMPORAL);
    RsReservoir fresh = rsReservoirs[rsPass.target].at[rsIndex(pixel)];
    rsReservoirs[rsPass.target].at[rsIndex(pixel)] =
        rsDiTemporal(s, fresh, previousPixel, expectedDepth, rsFrame.previousExtent, rsFrame.di, random);
}
