// Random numbers: one PCG stream (O'Neill 2014, RXS-M-XS, 32 bits) per pixel, frame and stage.
#ifndef RESTIR_CORE_RANDOM_GLSL
#define RESTIR_CORE_RANDOM_GLSL

// Streams of one frame; the spatial passes count up from theirs.
#define RS_STAGE_CANDIDATES 0u
#define RS_STAGE_TEMPORAL 1u
#define RS_STAGE_SPATIAL 2u
#define RS_STAGE_FILL 64u
#define RS_STAGE_OWN_LIGHT 65u
#define RS_STAGE_SHADE 66u
#define RS_STAGE_GI 128u   // and on from there as for DI

struct RsRandom { uint state; };

uint rsHash(uint value) {
    uint state = value * 747796405u + 2891336453u;
    uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}

RsRandom rsRandom(uvec2 pixel, uint seed, uint stage) {
    return RsRandom(rsHash(rsHash(pixel.x) + rsHash(pixel.y + rsHash(seed + rsHash(stage)))));
}

uint rsNextBits(inout RsRandom random) {
    uint bits = rsHash(random.state);
    random.state = random.state * 747796405u + 2891336453u;
    return bits;
}

// [0, 1), 24 bits.
float rsNext(inout RsRandom random) { return float(rsNextBits(random) >> 8u) * 5.9604644775390625e-8; }
vec2 rsNext2(inout RsRandom random) { return vec2(rsNext(random), rsNext(random)); }

// [0, count), by the high half of a product: even for a million lights the bias is below 3e-4.
uint rsNextIndex(inout RsRandom random, uint count) {
    uint high, low;
    umulExtended(rsNextBits(random), count, high, low);
    return high;
}

#endif
