#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/light_table.glsl"

// Excesses and deficits of each block, without the heaviest light's.
void main() {
    uvec4 sum = uvec4(0u);
    for (uint k = 0u; k < RS_TABLE_ITEMS; ++k)
        if (!rsIsHeaviest(rsItem(k))) sum = rsAddPair(sum, rsSurplusOf(rsItem(k)));
    rsGroupSum(sum);
    if (gl_LocalInvocationIndex == 0u) rsBlocks[gl_WorkGroupID.x] = rsGroupTotal();
}
