// Set 0 of LightTable's passes, and sums over a workgroup. They have no other order than that of the columns: whole
// numbers, and shared memory only.
#extension GL_EXT_scalar_block_layout : require
#include "restir/lights/alias.glsl"
#include "restir/shared/light_table.h"

layout(local_size_x = RS_TABLE_GROUP) in;
layout(push_constant, scalar) uniform RsPassBlock { RsTablePass rsPass; };
layout(set = 0, binding = RS_TABLE_BIND_STATE, scalar) buffer RsStateBlock { RsTableState rsState; };
layout(set = 0, binding = RS_TABLE_BIND_LIGHTS, scalar) buffer RsLights { RsPackedLight rsLights[]; };
layout(set = 0, binding = RS_TABLE_BIND_ALIAS, scalar) writeonly buffer RsAlias { RsAliasEntry rsAlias[]; };
layout(set = 0, binding = RS_TABLE_BIND_EXCESS, scalar) buffer RsExcess { uvec2 rsExcess[]; };
layout(set = 0, binding = RS_TABLE_BIND_DEFICIT, scalar) buffer RsDeficit { uvec2 rsDeficit[]; };
layout(set = 0, binding = RS_TABLE_BIND_BLOCKS, scalar) buffer RsBlocks { uvec4 rsBlocks[]; };

uvec2 rsLoadExcess(uint column) { return rsExcess[column]; }
uvec2 rsLoadDeficit(uint column) { return rsDeficit[column]; }
uint rsLoadPower(uint column) { return rsExcess[column].x; }   // before the running sums are stored there

// Item k of this invocation, in its block: neighbours in memory are neighbours among invocations.
uint rsItem(uint k) { return gl_WorkGroupID.x * RS_TABLE_BLOCK + k * RS_TABLE_GROUP + gl_LocalInvocationIndex; }

// Excess and deficit of a column; the heaviest light has its own.
bool rsIsHeaviest(uint column) { return column == ~rsState.heaviest; }
uvec4 rsSurplusOf(uint column) {
    return column < rsPass.columns ? rsSurplus(rsWeight(rsLoadPower(column), rsState.heaviestPower, rsState.scale))
                                   : uvec4(0u);
}

uvec4 rsAddPair(uvec4 a, uvec4 b) { return uvec4(rsAdd(a.xy, b.xy), rsAdd(a.zw, b.zw)); }
uvec4 rsSubtractPair(uvec4 a, uvec4 b) { return uvec4(rsSubtract(a.xy, b.xy), rsSubtract(a.zw, b.zw)); }

shared uvec4 rsGroupSums[RS_TABLE_GROUP];

// Sum of the values of this invocation and those before it. Called once by all.
uvec4 rsGroupSum(uvec4 value) {
    uint self = gl_LocalInvocationIndex;
    rsGroupSums[self] = value;
    for (uint distance = 1u; distance < RS_TABLE_GROUP; distance *= 2u) {
        barrier();
        uvec4 before = self >= distance ? rsGroupSums[self - distance] : uvec4(0u);
        barrier();
        value = rsAddPair(value, before);
        rsGroupSums[self] = value;
    }
    barrier();
    return value;
}
uvec4 rsGroupTotal() { return rsGroupSums[RS_TABLE_GROUP - 1u]; }
