#version 460
// Job 0: draws from a light tree, and what the tree says of them. Job 1: the chance of each light.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "restir/lights/source.glsl"
#define HOOKS_TREE
#include "gpu/shaders/include/hooks.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) readonly buffer Parameters {
    uint job, seed, count, invocations;
    vec3 receiver, normal;
};
layout(set = 0, binding = 1, scalar) readonly buffer Tree { uvec4 tree[]; };
struct Result {
    uint light;
    float chance;   // as drawn
    float again;    // as asked for
};
layout(set = 0, binding = 2, scalar) writeonly buffer Out { Result results[]; };

RsAliasEntry rsLoadAlias(uint column) { return RsAliasEntry(0u, 0u); }
uvec4 rsLoadTreeNode(uint slot) { return tree[slot]; }
uint rsLoadTreeWord(uint index) { return tree[index / 4u][index % 4u]; }

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= invocations) return;
    Result result = Result(i, 0.0, 0.0);
    RsRandom random = rsRandom(uvec2(i & 511u, i >> 9u), seed, 0u);
    if (job == 0u) result.light = rsSampleTree(receiver, normal, rsColumns(count), random, result.chance);
    if (result.light < count) result.again = rsTreeChance(result.light, receiver, normal, rsColumns(count));
    results[i] = result;
}
