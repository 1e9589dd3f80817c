// Partners, and what one notes for the other. For every index there is an involution of the pixels: if b is a's i-th
// partner, a is b's, so that each evaluates the other's sample once and both read both answers.
//
// The plane is cut into squares at a random offset, and each square into random pairs: a shuffle, a reflection at a random
// point between two columns, and the shuffle undone. Pixels side by side have unrelated partners; with displacements in
// common they would copy patterns of samples to one another.
#ifndef RESTIR_DI_PARTNER_GLSL
#define RESTIR_DI_PARTNER_GLSL
#include "restir/core/random.glsl"
#include "restir/di/field.glsl"
#include "restir/shared/di.h"

// Of index `i`, the same for all pixels of a pass: from the stream of a pixel that no picture has.
uint rsPartnerKey(uint seed, uint stage, uint i) { return rsRandom(uvec2(i, 0xffffffffu), seed, stage).state; }

// [0, n) from a value's high bits, n < 2^16. Random enough: n / 2^16 uneven.
uint rsPartnerDraw(uint value, uint n) { return (rsHash(value) >> 16u) * n >> 16u; }

// x + by modulo n, for x < n and by <= n.
uint rsTurn(uint x, uint by, uint n) { return x + by < n ? x + by : x + by - n; }

// Never `pixel` itself, but maybe outside of the picture. `n`: edge of the squares in pixels, even. Divides by n with a
// product, exact while (pixel + n) n < 2^32: GPUs have no integer division.
ivec2 rsPartner(uvec2 pixel, uint key, uint n) {
    uvec2 offset = uvec2(rsPartnerDraw(key, n), rsPartnerDraw(key + 1u, n));
    uvec2 at = pixel + offset, square, low;
    umulExtended(at, uvec2(0xffffffffu / n + 1u), square, low);
    at -= square * n;
    uint rows = rsHash(square.x + rsHash(square.y + key)), columns = rsHash(rows), mirrors = rsHash(columns);
    at.x = rsTurn(at.x, rsPartnerDraw(rows + at.y, n), n);
    at.y = rsTurn(at.y, rsPartnerDraw(columns + at.x, n), n);
    at.x = rsTurn(rsPartnerDraw(mirrors + at.y, n) | 1u, n - at.x, n);   // old + new is odd: they differ
    at.y = rsTurn(at.y, n - rsPartnerDraw(columns + at.x, n), n);
    at.x = rsTurn(at.x, n - rsPartnerDraw(rows + at.y, n), n);
    return ivec2(square * n + at) - ivec2(offset);
}

// The same among the pixels that the frame lights.
ivec2 rsPartnerPixel(uvec2 pixel, uint key, RsDiConstants di) {
    uvec2 cell = uvec2(rsFieldCell(ivec2(pixel), di.field));
    return rsFieldPixel(rsPartner(cell, key, di.partnerSquare), di.field);
}

// What a pixel notes for a partner: the target of the partner's sample here, with V, its low bits cut off. Any function
// of a sample may be its target as long as all weights take the same one (THEORY, section 3): nothing is biased by that.
#define RS_NO_PARTNER 0x8000u   // outside, or of another surface: it never existed
uint rsPackTarget(float target) { return floatBitsToUint(target) >> 16u; }
float rsUnpackTarget(uint bits) { return uintBitsToFloat(bits << 16u); }

#endif
