// Drawing a light by what it may bring to a receiver: a binary tree over all lights that are somewhere, descended from the root
// (Conty Estevez and Kulla 2018). The tree is that of the common prefixes of the lights' places along a Morton curve (Karras
// 2012): every node holds what is in some cube, or a half or a quarter of one.
//
// A node is the power of its lights, the mean m of their positions, weighted by power, and the mean square s of their distances
// from it: the mean of |y - x|^2 over them is |m - x|^2 + s. A receiver takes a child with a probability that goes with
// power / (|m - x|^2 + s / 4), and less where it is behind the receiver's plane; a quarter, since the mean of an inverse square
// is more than the inverse of the mean. Nothing is bounded and nothing needs to be: the descent is a probability like another, and
// what it is, is known.
//
// For n columns there are n - 1 inner nodes; 0 is the root. A child of node i is named by its slot, 2 i or 2 i + 1, and found there,
// so that siblings are neighbours in memory:
//     uvec4 [0, 2 n)      RsTreeNode of a slot
//     uint [8 n, 10 n)    what a slot holds: an inner node, or RS_TREE_LEAF | a light
//     uint [10 n, 11 n)   the slot of an inner node
//     uint [11 n, 12 n)   the slot of a light
#ifndef RESTIR_LIGHTS_TREE_GLSL
#define RESTIR_LIGHTS_TREE_GLSL
#include "restir/core/random.glsl"
#include "restir/shared/lights.h"
#include "restir/shared/scene.h"

uvec4 rsLoadTreeNode(uint slot);
uint rsLoadTreeWord(uint index);

#define RS_TREE_LEAF 0x80000000u
#define RS_TREE_DEEPEST 64u   // 30 bits of a key, 20 of an index

uint rsTreeBelow(uint columns, uint slot) { return 8u * columns + slot; }
uint rsTreeSlotOfNode(uint columns, uint node) { return 10u * columns + node; }
uint rsTreeSlotOfLight(uint columns, uint light) { return 11u * columns + light; }

struct RsTreeNode {
    vec3 mean;
    float spread;   // s, m^2
    float power;
};

// The upper half of a float, to the nearest; for values >= 0.
uint rsShorten(float value) { return min(floatBitsToUint(value) + 0x4000u, 0x7f7fffffu) >> 15u; }

// 16 bytes: means as they are, spread and power with 9 bits of mantissa.
uvec4 rsPackTreeNode(RsTreeNode node) {
    return uvec4(floatBitsToUint(node.mean), rsShorten(node.spread) << 16u | rsShorten(node.power));
}
RsTreeNode rsUnpackTreeNode(uvec4 bits) {
    return RsTreeNode(uintBitsToFloat(bits.xyz), uintBitsToFloat(bits.w >> 16u << 15u), uintBitsToFloat((bits.w & 0xffffu) << 15u));
}

// Both nodes as one.
RsTreeNode rsJoin(RsTreeNode a, RsTreeNode b) {
    float power = a.power + b.power;
    if (!(power > 0.0)) return RsTreeNode(vec3(0.0), 0.0, 0.0);
    float share = b.power / power;
    vec3 between = b.mean - a.mean;
    float apart = share * (1.0 - share) * dot(between, between);
    return RsTreeNode(a.mean + share * between, mix(a.spread, b.spread, share) + apart, power);
}

// What is left to lights that seem to be behind the receiver's plane, whose nodes may reach in front of it.
#define RS_TREE_BEHIND 0.05
// Of s, by measurement: among lights in a plane, in heaps and all over a room 1 is up to 1.7 times as noisy.
#define RS_TREE_SPREAD 0.25

// `normal`: of the receiver's plane, unit; 0 if it is lit from everywhere. Not a number, infinite or negative: never.
float rsTreeImportance(RsTreeNode node, vec3 receiver, vec3 normal) {
    vec3 to = node.mean - receiver;
    float away = max(dot(to, to), 1e-12);   // m^2
    float facing = (dot(normal, to) + sqrt(node.spread)) * inversesqrt(away);
    if (normal == vec3(0.0)) facing = 1.0;
    float importance = node.power * clamp(facing, RS_TREE_BEHIND, 1.0) / (away + RS_TREE_SPREAD * node.spread);
    return importance > 0.0 && importance < 3e38 ? importance : 0.0;
}
float rsTreeImportance(uint slot, vec3 receiver, vec3 normal) {
    return rsTreeImportance(rsUnpackTreeNode(rsLoadTreeNode(slot)), receiver, normal);
}

// A light, and with which probability it is found; RS_NO_LIGHT and 0 where there is none to be found. `columns` as in
// rsSampleLight.
uint rsSampleTree(vec3 receiver, vec3 normal, uint columns, inout RsRandom random, out float chance) {
    chance = 1.0;
    uint node = 0u;
    for (uint depth = 0u; depth < RS_TREE_DEEPEST; ++depth) {
        float first = rsTreeImportance(2u * node, receiver, normal);
        float second = rsTreeImportance(2u * node + 1u, receiver, normal);
        float total = first + second;
        bool takesFirst = rsNext(random) * total < first;
        chance *= (takesFirst ? first : second) / total;
        if (!(chance > 0.0)) break;
        node = rsLoadTreeWord(rsTreeBelow(columns, 2u * node + (takesFirst ? 0u : 1u)));
        if ((node & RS_TREE_LEAF) != 0u) return node & ~RS_TREE_LEAF;
    }
    chance = 0.0;
    return RS_NO_LIGHT;
}

// That probability, of any light: from its leaf up.
float rsTreeChance(uint light, vec3 receiver, vec3 normal, uint columns) {
    float chance = 1.0;
    uint slot = rsLoadTreeWord(rsTreeSlotOfLight(columns, light));
    for (uint depth = 0u; depth < RS_TREE_DEEPEST; ++depth) {
        float own = rsTreeImportance(slot, receiver, normal);
        float other = rsTreeImportance(slot ^ 1u, receiver, normal);
        if (!(own > 0.0)) return 0.0;
        chance *= own / (own + other);
        if (slot < 2u) break;
        slot = rsLoadTreeWord(rsTreeSlotOfNode(columns, slot / 2u));
    }
    return chance;
}

#endif
