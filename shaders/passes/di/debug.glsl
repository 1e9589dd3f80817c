#version 460
#extension GL_GOOGLE_include_directive : require
#define RS_PASS_RAYS
#include "passes/bindings.glsl"
#include "restir/di/debug.glsl"

layout(set = RS_SET, binding = RS_BIND_DEBUG) uniform writeonly image2D rsDebugImage;

void main() {
    if (!rsInside()) return;
    uvec2 pixel = gl_GlobalInvocationID.xy;
    RsSurface s = rsLoadSurface(pixel);
    RsRandom random = rsRandom(pixel, rsFrame.seed, RS_STAGE_SPATIAL + rsPass.index);
    vec4 shown = vec4(0.0);
    if (s.valid) shown = rsDiDebug(rsFrame.debugView, s, pixel, rsFrame.extent, rsFrame.di, random);
    imageStore(rsDebugImage, ivec2(pixel + rsFrame.outputOrigin), shown);
}
