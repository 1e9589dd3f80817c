#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/light_tree.glsl"

// One workgroup: where each block's keys with each digit begin.
void main() {
    uint counts = RS_TABLE_DIGITS * rsPass.blocks, each = (counts + RS_TABLE_GROUP - 1u) / RS_TABLE_GROUP;
    uint first = gl_LocalInvocationIndex * each, last = min(first + each, counts), sum = 0u;
    for (uint i = first; i < last; ++i) sum += rsCounts[i];
    uint next = rsGroupSum(uvec4(sum, 0u, 0u, 0u)).x - sum;
    for (uint i = first; i < last; ++i) {
        uint count = rsCounts[i];
        rsCounts[i] = next;
        next += count;
    }
}
