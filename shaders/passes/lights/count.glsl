#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/light_tree.glsl"

shared uint rsDigitCounts[RS_TABLE_DIGITS];

// How often a block has each digit.
void main() {
    uint self = gl_LocalInvocationIndex;
    if (self < RS_TABLE_DIGITS) rsDigitCounts[self] = 0u;
    barrier();
    for (uint k = 0u; k < RS_TABLE_ITEMS; ++k)
        if (rsItem(k) < rsPass.columns) atomicAdd(rsDigitCounts[rsDigit(rsLoadSorted(rsItem(k)).x)], 1u);
    barrier();
    if (self < RS_TABLE_DIGITS) rsCounts[self * rsPass.blocks + gl_WorkGroupID.x] = rsDigitCounts[self];
}
