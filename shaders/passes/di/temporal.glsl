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
        vec2 jitter = 0.5 * (rsFrame.previousView.jitter * vec2(rsFrame.previousExtent) - rsFrame.view.jitter * vec2(rsFrame.extent));
        previousPixel = vec2(pixel) + 0.5 + unpackHalf2x16(rsSurfacesFrame[rsIndex(pixel)].x) + jitter;
    }
    RsRandom random = rsRandom(pixel, rsFrame.seed, RS_STAGE_TEMPORAL);
    RsReservoir fresh = rsReservoirs[rsPass.target].at[rsIndex(pixel)];
    rsReservoirs[rsPass.target].at[rsIndex(pixel)] =
        rsDiTemporal(s, fresh, previousPixel, expectedDepth, rsFrame.previousExtent, rsFrame.di, random);
}
