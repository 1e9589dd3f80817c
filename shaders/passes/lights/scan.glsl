#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/light_table.glsl"

// Running sums of excesses and deficits.
void main() {
    uint first = gl_WorkGroupID.x * RS_TABLE_BLOCK + gl_LocalInvocationIndex * RS_TABLE_ITEMS;
    uvec4 own[RS_TABLE_ITEMS], sum = uvec4(0u);
    for (uint k = 0u; k < RS_TABLE_ITEMS; ++k) {
        own[k] = rsIsHeaviest(first + k) ? uvec4(rsState.surplus, 0u, 0u) : rsSurplusOf(first + k);
        sum = rsAddPair(sum, own[k]);
    }
    uvec4 running = rsAddPair(rsSubtractPair(rsGroupSum(sum), sum), rsBlocks[gl_WorkGroupID.x]);
    for (uint k = 0u; k < RS_TABLE_ITEMS && first + k < rsPass.columns; ++k) {
        running = rsAddPair(running, own[k]);
        rsExcess[first + k] = running.xy;
        rsDeficit[first + k] = running.zw;
    }
}
