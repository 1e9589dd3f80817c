// Unsigned integers of 64 bits: x is the low word. Devices need not have them.
#ifndef RESTIR_CORE_WIDE_GLSL
#define RESTIR_CORE_WIDE_GLSL

uvec2 rsAdd(uvec2 a, uvec2 b) {
    uint carry;
    uint low = uaddCarry(a.x, b.x, carry);
    return uvec2(low, a.y + b.y + carry);
}

uvec2 rsSubtract(uvec2 a, uvec2 b) {
    uint borrow;
    uint low = usubBorrow(a.x, b.x, borrow);
    return uvec2(low, a.y - b.y - borrow);
}

bool rsLess(uvec2 a, uvec2 b) { return a.y < b.y || (a.y == b.y && a.x < b.x); }

// shift in [0, 63].
uvec2 rsShiftLeft(uvec2 a, uint shift) {
    if (shift == 0u) return a;
    if (shift >= 32u) return uvec2(0u, a.x << (shift - 32u));
    return uvec2(a.x << shift, a.y << shift | a.x >> (32u - shift));
}
uvec2 rsShiftRight(uvec2 a, uint shift) {
    if (shift == 0u) return a;
    if (shift >= 32u) return uvec2(a.y >> (shift - 32u), 0u);
    return uvec2(a.x >> shift | a.y << (32u - shift), a.y >> shift);
}

// Bits 32 to 95 of a product below 2^96.
uvec2 rsMultiplyHigh(uvec2 a, uvec2 b) {
    uint low, high, high01, low01, high10, low10, carry0, carry1;
    umulExtended(a.x, b.x, high, low);
    umulExtended(a.x, b.y, high01, low01);
    umulExtended(a.y, b.x, high10, low10);
    uint middle = uaddCarry(high, low01, carry0);
    middle = uaddCarry(middle, low10, carry1);
    return uvec2(middle, high01 + high10 + a.y * b.y + carry0 + carry1);
}

// floor(a 2^bits / b) with a < b < 2^63, if that is below 2^64.
uvec2 rsDivide(uint a, uint bits, uvec2 b) {
    uvec2 remainder = uvec2(a, 0u), quotient = uvec2(0u);
    for (uint i = 0u; i < bits; ++i) {
        remainder = rsShiftLeft(remainder, 1u);
        quotient = rsShiftLeft(quotient, 1u);
        if (rsLess(remainder, b)) continue;
        remainder = rsSubtract(remainder, b);
        quotient.x |= 1u;
    }
    return quotient;
}

#endif
