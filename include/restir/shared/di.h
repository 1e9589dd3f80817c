// ReSTIR DI: what its passes and the host agree on.
#ifndef RESTIR_SHARED_DI_H
#define RESTIR_SHARED_DI_H
#include "restir/shared/types.h"
RS_SHARED_BEGIN

// One light sample kept for one pixel, 16 bytes. What can be recomputed (target, position) is not stored.
struct RsReservoir {
    uint light;        // light id; RS_NO_LIGHT when empty
    uint uv;           // 2 x 16-bit position on the light
    float ucw;         // unbiased contribution weight W; finite and >= 0, checked before the store
    uint confidence;   // bits 0..15 confidence M in pixel-frames, bits 16..31 age in frames
};

struct RsDiConstants {
    uint lightCandidates;
    uint bsdfCandidates;
    uint maxHistory;
    uint neighbours;
    float radius;              // pixels
    float normalThreshold;     // cosine
    float depthThreshold;      // relative
    uint weights;              // RS_WEIGHTS_*
    uint visibility;           // RS_VISIBILITY_*
    float boilingFilter;       // [0, 1]
    uint initialSamples;
    uint partnerSquare;        // pixels, even: edge of the squares that partners are drawn in
    uint freshConfidence;      // pixel-frames that a fresh reservoir stands for
    uint field;                // of the pixels that this frame lights: restir/di/field.glsl
    uint previousField;        // and that the last one lit
    float treeShare;           // of the lights tried, drawn from the tree; 0 without one
    uint permutation;          // of history pixels: 0 off, else 16 + this frame's corner of the blocks, 2 bits x, 2 y
};

RS_SHARED_END

#define RS_WEIGHTS_OFF 0u
#define RS_WEIGHTS_BASIC 1u
#define RS_WEIGHTS_BALANCE 2u
#define RS_WEIGHTS_PAIRWISE 3u
#define RS_WEIGHTS_PAIRWISE_PLAIN 4u
#define RS_VISIBILITY_NONE 0u
#define RS_VISIBILITY_CACHED 1u
#define RS_VISIBILITY_TRACED 2u
#define RS_FIELD_ALL 0u      // restir/di/field.glsl
#define RS_FIELD_PAIRS 1u    // and the next one
#define RS_FIELD_BLOCKS 4u   // and the next three
#define RS_DEBUG_NONE 0u
#define RS_DEBUG_CONFIDENCE 1u
#define RS_DEBUG_AGE 2u
#define RS_DEBUG_WEIGHT 3u
#define RS_DEBUG_LIGHT 4u
#define RS_DEBUG_VISIBILITY 5u
#define RS_DEBUG_NEIGHBOURS 6u
#define RS_DEBUG_SAMPLES 7u
#define RS_DEBUG_DUPLICATES 8u

#endif
