#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/light_table.glsl"

// One workgroup: what the blocks before each sum up to, and what is left for the heaviest light.
void main() {
    uint first = gl_LocalInvocationIndex * RS_TABLE_ITEMS;
    uvec4 own[RS_TABLE_ITEMS], sum = uvec4(0u);
    for (uint k = 0u; k < RS_TABLE_ITEMS; ++k) {
        own[k] = first + k < rsPass.blocks ? rsBlocks[first + k] : uvec4(0u);
        sum = rsAddPair(sum, own[k]);
    }
    uvec4 before = rsSubtractPair(rsGroupSum(sum), sum);
    uvec2 surplus = rsSubtract(rsGroupTotal().zw, rsGroupTotal().xy);
    if (gl_LocalInvocationIndex == 0u) rsState.surplus = surplus;
    for (uint k = 0u; k < RS_TABLE_ITEMS; ++k) {
        bool after = first + k > ~rsState.heaviest / RS_TABLE_BLOCK;
        if (first + k < rsPass.blocks) rsBlocks[first + k] = rsAddPair(before, after ? uvec4(surplus, 0u, 0u) : uvec4(0u));
        before = rsAddPair(before, own[k]);
    }
}
