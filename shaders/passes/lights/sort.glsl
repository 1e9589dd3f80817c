#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/light_tree.glsl"

// Rows of two digits, 16 bits each: how many keys of the invocations before each have them.
#define RS_ROWS (RS_TABLE_DIGITS / 2u)
#define RS_PER_ROW (RS_TABLE_GROUP / RS_ROWS)   // invocations that sum up a row
shared uint rsBefore[RS_ROWS][RS_TABLE_GROUP];
shared uint rsParts[RS_TABLE_GROUP];

uint rsOneOf(uint digit) { return 1u << 16u * (digit % 2u); }
uint rsOf(uint pair, uint digit) { return pair >> 16u * (digit % 2u) & 0xffffu; }

void rsSumRows() {
    uint row = gl_LocalInvocationIndex / RS_PER_ROW, part = gl_LocalInvocationIndex % RS_PER_ROW;
    uint each = RS_TABLE_GROUP / RS_PER_ROW, sum = 0u;
    barrier();
    for (uint i = 0u; i < each; ++i) sum += rsBefore[row][part * each + i];
    rsParts[gl_LocalInvocationIndex] = sum;
    barrier();
    sum = 0u;
    for (uint i = 0u; i < part; ++i) sum += rsParts[row * RS_PER_ROW + i];
    for (uint i = 0u; i < each; ++i) {
        uint own = rsBefore[row][part * each + i];
        rsBefore[row][part * each + i] = sum;
        sum += own;
    }
    barrier();
}

void main() {
    uint self = gl_LocalInvocationIndex, first = gl_WorkGroupID.x * RS_TABLE_BLOCK + self * RS_TABLE_ITEMS;
    uvec2 entries[RS_TABLE_ITEMS];
    for (uint row = 0u; row < RS_ROWS; ++row) rsBefore[row][self] = 0u;
    for (uint k = 0u; k < RS_TABLE_ITEMS; ++k) {
        if (first + k >= rsPass.columns) break;
        entries[k] = rsLoadSorted(first + k);
        uint digit = rsDigit(entries[k].x);
        rsBefore[digit / 2u][self] += rsOneOf(digit);
    }
    rsSumRows();
    for (uint k = 0u; k < RS_TABLE_ITEMS; ++k) {
        if (first + k >= rsPass.columns) break;
        uint digit = rsDigit(entries[k].x);
        rsStoreSorted(rsCounts[digit * rsPass.blocks + gl_WorkGroupID.x] + rsOf(rsBefore[digit / 2u][self], digit), entries[k]);
        rsBefore[digit / 2u][self] += rsOneOf(digit);
    }
}
