#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/light_table.glsl"

// Of quantised powers, and which light is the heaviest.
shared uint rsHeaviest;

void main() {
    if (gl_LocalInvocationIndex == 0u) rsHeaviest = 0u;
    barrier();
    uvec2 sum = uvec2(0u);
    for (uint k = 0u; k < RS_TABLE_ITEMS; ++k) {
        uint column = rsItem(k), code = column < rsPass.columns ? rsLoadPower(column) : 0u;
        sum = rsAdd(sum, rsQuantisedPower(code, rsState.heaviestPower));
        if (code > 0u && code == rsState.heaviestPower) atomicMax(rsHeaviest, ~column);
    }
    rsGroupSum(uvec4(sum, 0u, 0u));
    if (gl_LocalInvocationIndex != 0u) return;
    rsBlocks[gl_WorkGroupID.x] = rsGroupTotal();
    atomicMax(rsState.heaviest, rsHeaviest);
}
