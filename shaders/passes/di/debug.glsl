#version 460
#extension GL_GOOGLE_include_directive : require
#define RS_PASS_RAYS
#include "passes/bindings.glsl"
#include "restir/di/debug.glsl"

layout(set = RS_SET, binding = RS_BIND_DEBUG) uniform writeonly image2D rsDebugImage;

void main() {
    uvec2 at = rsPixelOn(RS_FIELD_ALL), pixel = at;
    if (!rsInside(at)) return;
    if (!rsIsOnField(ivec2(at), rsFrame.di.field)) pixel.x = at.x > 0u ? at.x - 1u : 1u;   // shows the one beside it
    RsSurface s = rsLoadSurface(pixel);
    RsRandom random = rsRandom(pixel, rsFrame.seed, RS_STAGE_SPATIAL + rsPass.index);
    vec4 shown = vec4(0.0);
    if (s.valid) shown = rsDiDebug(rsFrame.debugView, s, pixel, rsFrame.extent, rsFrame.di, random);
    imageStore(rsDebugImage, ivec2(at + rsFrame.outputOrigin), shown);
}
