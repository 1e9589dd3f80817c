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
//     uvec4 [0, 2 n - 2)  RsTreeNode of a slot
//     uvec4 2 n - 1       RsTreeNode of them all
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

uint rsTreeRoot(uint columns) { return 2u * columns - 1u; }
uint rsTreeBelow(uint columns, uint slot) { return 8u * columns + slot; }
uint rsTreeSlotOfNode(uint columns, uint node) { return 10u * columns + node; }
uint rsTreeSlotOfLight(uint columns, uint light) { return 11u * columns + light; }

struct RsTreeNode {
    vec3 mean;
    float radius;   // sqrt(s), metres
    float power;
};

// The upper half of a float, to the nearest; for values >= 0.
uint rsShorten(float value) { return min(floatBitsToUint(value) + 0x4000u, 0x7f7fffffu) >> 15u; }

// 16 bytes: means as they are, radius and power with 9 bits of mantissa.
uvec4 rsPackTreeNode(RsTreeNode node) {
    return uvec4(floatBitsToUint(node.mean), rsShorten(node.radius) << 16u | rsShorten(node.power));
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
    return RsTreeNode(a.mean + share * between, sqrt(mix(a.radius * a.radius, b.radius * b.radius, share) + apart), power);
}

// What is left to lights that seem to be behind the receiver's plane, whose nodes may reach in front of it.
#define RS_TREE_BEHIND 0.05
// Of s, by measurement: among lights in a plane, in heaps and all over a room 1 is up to 1.7 times as noisy.
#define RS_TREE_SPREAD 0.25

// `normal`: of the receiver's plane, unit; 0: it has none. Not a number, infinite or negative: never.
float rsTreeImportance(RsTreeNode node, vec3 receiver, vec3 normal) {
    vec3 to = node.mean - receiver;
    float inverse = inversesqrt(max(dot(to, to) + RS_TREE_SPREAD * node.radius * node.radius, 1e-12));   // 1/m
    float facing = normal == vec3(0.0) ? 1.0 : clamp((dot(normal, to) + node.radius) * inverse, RS_TREE_BEHIND, 1.0);
    float importance = node.power * facing * inverse * inverse;
    return importance > 0.0 && importance < 3e38 ? importance : 0.0;
}
float rsTreeImportance(uint slot, vec3 receiver, vec3 normal) {
    return rsTreeImportance(rsUnpackTreeNode(rsLoadTreeNode(slot)), receiver, normal);
}

// Where all lights are in one place, seen from far away, power is all there is to know of them: beyond this many times the
// mean square distance of lights from their mean.
#define RS_TREE_FAR 8.0

// How much of `share` a receiver draws from the tree: nothing that would be in vain, and less where most of the power is that of
// lights at infinity, which are not in it.
float rsTreeShare(float share, vec3 receiver, uint columns) {
    RsTreeNode all = rsUnpackTreeNode(rsLoadTreeNode(rsTreeRoot(columns)));
    vec3 to = all.mean - receiver;
    return dot(to, to) < RS_TREE_FAR * all.radius * all.radius ? share * clamp(4.0 * all.power, 0.25, 1.0) : 0.0;
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
