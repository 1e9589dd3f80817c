// The alias table (Walker 1977, Vose 1991), built column by column from running sums (after Huebschle-Schneider and
// Sanders 2019) in whole numbers, so that it is the same whatever the order of invocations and what it draws is known
// exactly.
//
// n columns (a power of two, so that 32 random bits choose one evenly) of 2^32 each hold the weights w_i, which sum up
// to n 2^32. Where w_i is less than a column, the deficit 2^32 - w_i is filled by another light; where it is more, the
// excess w_i - 2^32 fills others. Think of all deficits and all excesses in a row each, in the order of the columns: E_i and
// D_i are their running sums, E_n = D_n. A deficit is filled whole by the light whose excess is under its lower end; if that
// excess ends earlier, the rest comes out of that light's own column, which the next excess fills in turn.
//
// Weights: a power code becomes q < 2^43, relative to the largest; S = sum of q; w = floor(q n 2^32 / S), at least 1. The
// heaviest light takes what this leaves, up to 2^-31 of all: it weighs a column at least, since the others sum up
// to no more than they should, plus 1 for each that was raised to 1 and so left a column free.
#ifndef RESTIR_LIGHTS_ALIAS_GLSL
#define RESTIR_LIGHTS_ALIAS_GLSL
#include "restir/core/wide.glsl"
#include "restir/shared/lights.h"

uvec2 rsLoadExcess(uint column);    // E of this column and all before it
uvec2 rsLoadDeficit(uint column);   // D likewise

// Of a code of rsPowerCode; the heaviest code is in [2^42, 2^43).
uvec2 rsQuantisedPower(uint code, uint heaviest) {
    if (code == 0u) return uvec2(0u);
    uvec2 mantissa = rsShiftLeft(uvec2((code & 0x3fffffu) | 0x400000u, 0u), 20u);
    return rsShiftRight(mantissa, min((heaviest >> 22u) - (code >> 22u), 63u));
}

// n / S in units of 2^-75: below 2^54, and at least 32 bits of it.
uvec2 rsWeightScale(uvec2 sum, uint columns) { return rsDivide(columns, 75u, sum); }

// Of all but the heaviest light.
uvec2 rsWeight(uint code, uint heaviest, uvec2 scale) {
    if (code == 0u) return uvec2(0u);
    uvec2 weight = rsShiftRight(rsMultiplyHigh(rsQuantisedPower(code, heaviest), scale), 11u);   // of 2^-43
    return weight == uvec2(0u) ? uvec2(1u, 0u) : weight;
}

// Excess in xy, deficit in zw.
uvec4 rsSurplus(uvec2 weight) {
    return weight.y > 0u ? uvec4(weight.x, weight.y - 1u, 0u, 0u)
                         : uvec4(0u, 0u, rsSubtract(uvec2(0u, 1u), weight));
}

// The first column whose running sum is above `value`; there is one.
uint rsFirstExcessAbove(uvec2 value, uint columns) {
    uint first = 0u, last = columns - 1u;
    while (first < last) {
        uint middle = (first + last) / 2u;
        if (rsLess(value, rsLoadExcess(middle))) last = middle;
        else first = middle + 1u;
    }
    return first;
}
// The first that is not below it.
uvec2 rsFirstDeficitFrom(uvec2 value, uint columns) {
    uint first = 0u, last = columns - 1u;
    while (first < last) {
        uint middle = (first + last) / 2u;
        if (rsLess(rsLoadDeficit(middle), value)) first = middle + 1u;
        else last = middle;
    }
    return rsLoadDeficit(first);
}

struct RsColumn {
    RsAliasEntry entry;
    float selection;   // of its own light
};

RsColumn rsAliasColumn(uint column, uint columns) {
    uvec2 excess = rsLoadExcess(column), deficit = rsLoadDeficit(column);
    uvec2 excessBefore = column > 0u ? rsLoadExcess(column - 1u) : uvec2(0u);
    uvec2 deficitBefore = column > 0u ? rsLoadDeficit(column - 1u) : uvec2(0u);
    uvec2 own = rsSubtract(excess, excessBefore), lacking = rsSubtract(deficit, deficitBefore);
    uvec2 weight = rsSubtract(rsAdd(uvec2(0u, 1u), own), lacking);
    RsColumn result;
    result.selection = (float(weight.y) * 4294967296.0 + float(weight.x)) / 4294967296.0 / float(columns);

    uvec2 from = deficitBefore;
    if (own != uvec2(0u)) {   // what it is asked for beyond its excess
        lacking = rsSubtract(rsFirstDeficitFrom(excess, columns), excess);
        from = excess;
    }
    // 2^32 - lacking, which for a whole column of its own is no number of 32 bits
    result.entry = lacking == uvec2(0u) ? RsAliasEntry(0xffffffffu, column)
                                        : RsAliasEntry(0u - lacking.x, rsFirstExcessAbove(from, columns));
    return result;
}

// Of a table without any power: draws what is not drawn.
RsColumn rsDarkColumn(uint column) { return RsColumn(RsAliasEntry(0xffffffffu, column), 0.0); }

#endif
