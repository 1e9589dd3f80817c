#version 460
#extension GL_GOOGLE_include_directive : require
#define RS_PASS_RAYS
#include "passes/bindings.glsl"
#include "passes/back_project.glsl"
#include "restir/di/gradient.glsl"
#include "restir/di/temporal.glsl"

layout(set = RS_SET, binding = RS_BIND_GRADIENT) uniform writeonly image2D rsGradientImage;

void store(uvec2 pixel, vec4 value) { imageStore(rsGradientImage, ivec2(pixel + rsFrame.outputOrigin), value); }

void main() {
    uvec2 pixel = rsPixel();
    if (!rsInside(pixel)) return;
    RsSurface s = rsLoadSurface(pixel);
    vec4 result = vec4(0.0);
    if (s.valid) {
        RsReservoir now = rsReservoirs[rsPass.target].at[rsIndex(pixel)];
        RsReservoir then = rsEmptyReservoir(0u);
        bool known = false;
        if ((rsFrame.flags & RS_FRAME_HISTORY) != 0u) {
            RsRandom random = rsRandom(pixel, rsFrame.seed, RS_STAGE_TEMPORAL);
            RsNeighbourhood where = rsFindHistory(s, rsBackProject(pixel, s), rsFrame.di, random);
            known = where.accepted != 0u;
            if (known) then = rsLoadHistory(where.pixel);
        }
        vec2 change = rsDiGradient(s, now, then, known, rsFrame.di.visibility);
        result = vec4(rsConfidence(now), change.y > 0.0 ? change.x / change.y : 0.0, change * rsFrame.exposure);
    }
    store(pixel, result);
    if (rsFrame.di.field == RS_FIELD_ALL) return;
    if (rsInside(pixel + uvec2(1u, 0u))) store(pixel + uvec2(1u, 0u), result);
    if (pixel.x == 1u) store(uvec2(0u, pixel.y), result);
}
