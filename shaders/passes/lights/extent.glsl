#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/light_table.glsl"
#include "restir/lights/extent.glsl"

shared uint rsHigh[3], rsLow[3];

void main() {
    if (gl_LocalInvocationIndex < 3u) rsHigh[gl_LocalInvocationIndex] = rsLow[gl_LocalInvocationIndex] = 0u;
    barrier();
    for (uint k = 0u; k < RS_TABLE_ITEMS; ++k) {
        uint id = rsItem(k);
        if (id >= rsPass.lights || !rsIsFinite(rsLights[id].kindAndTexture & RS_LIGHT_KIND_MASK)) continue;
        vec3 position = rsLights[id].position;
        for (uint i = 0u; i < 3u; ++i) {
            atomicMax(rsHigh[i], rsOrdered(position[i]));
            atomicMax(rsLow[i], rsOrdered(-position[i]));
        }
    }
    barrier();
    if (gl_LocalInvocationIndex < 3u) {
        atomicMax(rsState.high[gl_LocalInvocationIndex], rsHigh[gl_LocalInvocationIndex]);
        atomicMax(rsState.low[gl_LocalInvocationIndex], rsLow[gl_LocalInvocationIndex]);
    }
}
