#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/light_table.glsl"

// One workgroup.
void main() {
    uvec4 sum = uvec4(0u);
    for (uint k = 0u; k < RS_TABLE_ITEMS; ++k)
        if (rsItem(k) < rsPass.blocks) sum = rsAddPair(sum, rsBlocks[rsItem(k)]);
    rsGroupSum(sum);
    if (gl_LocalInvocationIndex == 0u && rsState.heaviestPower > 0u)
        rsState.scale = rsWeightScale(rsGroupTotal().xy, rsPass.columns);
}
