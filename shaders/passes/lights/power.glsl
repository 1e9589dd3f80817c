#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/light_table.glsl"
#include "restir/lights/extent.glsl"

shared uint rsHeaviest;

void main() {
    if (gl_LocalInvocationIndex == 0u) rsHeaviest = 0u;
    barrier();
    RsScaled area = rsSceneArea(uvec3(rsState.high[0], rsState.high[1], rsState.high[2]),
                                uvec3(rsState.low[0], rsState.low[1], rsState.low[2]));
    for (uint k = 0u; k < RS_TABLE_ITEMS; ++k) {
        uint column = rsItem(k);
        if (column >= rsPass.columns) continue;
        uint code = column < rsPass.lights ? rsPowerCode(rsLightPower(rsLights[column], area)) : 0u;
        rsExcess[column].x = code;
        atomicMax(rsHeaviest, code);
    }
    barrier();
    if (gl_LocalInvocationIndex == 0u) atomicMax(rsState.heaviestPower, rsHeaviest);
}
