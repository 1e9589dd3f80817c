// The software ray backend's trees: shaders/restir/rays/software.glsl walks them.
#ifndef RESTIR_SHARED_BVH_H
#define RESTIR_SHARED_BVH_H
#include "restir/shared/types.h"
RS_SHARED_BEGIN

// Two children and their boxes. Shaders read it as four vectors of 16 bytes: entry e = 2 node + (0 or 1), one
// child, is vectors 2e and 2e + 1, so the other child of its node is entry e ^ 1.
struct RsBvhNode {
    vec3 low0;
    uint child0;   // a word: an inner node, or RS_BVH_LEAF and what is in it
    vec3 high0;
    uint parent;   // entry that leads here; nothing that a root's is asked for
    vec3 low1;
    uint child1;
    vec3 high1;
    uint spare;
};

// One corner of a triangle. `id` of corner 0: the primitive; of corner 1: the geometry, and RS_BVH_NOT_OPAQUE.
struct RsBvhCorner {
    vec3 position;   // object space
    uint id;
};

struct RsBvhInstance {
    vec4 objectFromWorld[3];   // rows
    uint root;                 // word of its mesh's tree
    uint record;               // of the mesh's first geometry
    uint spare[2];
};

RS_SHARED_END

#define RS_BVH_LEAF 0x80000000u
#define RS_BVH_INSTANCE 0x40000000u   // of a leaf: one instance, else 1 to 4 triangles
#define RS_BVH_EMPTY 0xffffffffu      // a tree with nothing in it
#define RS_BVH_INDEX 0x0fffffffu      // of a leaf: its instance or first triangle
#define RS_BVH_COUNT_SHIFT 28         // of a leaf: bits 28 and 29 are the number of triangles less one
#define RS_BVH_LEAF_TRIANGLES 4u
#define RS_BVH_DEPTH 32u              // of a tree, at most: one bit a level says what is left to visit
#define RS_BVH_NOT_OPAQUE 0x80000000u

#endif
