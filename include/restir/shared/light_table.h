// What LightTable's own passes share with the host: restir/lights/alias.glsl says what they compute.
#ifndef RESTIR_SHARED_LIGHT_TABLE_H
#define RESTIR_SHARED_LIGHT_TABLE_H
#include "restir/shared/types.h"
RS_SHARED_BEGIN

// Push constants of every pass.
struct RsTablePass {
    uint lights;       // one more than the largest id
    uint columns;      // of the alias table
    uint blocks;       // of RS_TABLE_BLOCK columns
    uint meshLights;   // ids below are of meshes, or of nothing
    uint meshes;
    uint shift;        // of the tree's sort: bits below the digit that is sorted by
};

// Triangles of a record of the scene, by the id of the first one.
struct RsLightMesh {
    uint firstLight;
    uint triangles;
    uint record;
};

// Sums over a whole build. Starts as zeros.
struct RsTableState {
    uint high[3];          // the finite lights' bounds: restir/lights/extent.glsl
    uint low[3];
    uint heaviestPower;    // the largest power code
    uint heaviest;         // ~id of the first light that has it
    uvec2 scale;           // from quantised powers to weights
    uvec2 surplus;         // the heaviest light's weight beyond a column
};

RS_SHARED_END

// Set 0 of LightTable's passes.
#define RS_TABLE_BIND_STATE 0
#define RS_TABLE_BIND_LIGHTS 1
#define RS_TABLE_BIND_ALIAS 2
#define RS_TABLE_BIND_EXCESS 3     // uvec2 a column: power code, then running sum of excesses
#define RS_TABLE_BIND_DEFICIT 4    // uvec2 a column: running sum of deficits
#define RS_TABLE_BIND_BLOCKS 5     // uvec4 a block: sums, then what the blocks before it sum up to
#define RS_TABLE_BIND_MESHES 6     // RsLightMesh, by ascending ids
#define RS_TABLE_BIND_MEANS 7      // vec3 a light of a mesh: mean of its texture
#define RS_TABLE_BIND_TREE 8       // uint: restir/lights/tree.glsl
#define RS_TABLE_BIND_COUNTS 9     // uint: keys with each digit in each block, then where they go
#define RS_TABLE_BIND_COUNT 10

#define RS_TABLE_GROUP 128u         // what every device has
#define RS_TABLE_ITEMS 8u          // of an invocation
#define RS_TABLE_BLOCK 1024u       // of a workgroup; 1024 blocks, which one workgroup sums up, are 2^20 columns
#define RS_TABLE_DIGIT_BITS 5u     // of a radix sort: an even number of digits of a key
#define RS_TABLE_DIGITS 32u
#define RS_TABLE_ROW 1024u         // workgroups of a light each, in x

#endif
