#version 460
// Job 0: the first numbers of the streams of a 512 x 512 picture. Job 1: draws from an alias table.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "restir/lights/table.glsl"
#include "gpu/shaders/include/hooks.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) readonly buffer Parameters { uint job, seed, stage, count; };
layout(set = 0, binding = 1, scalar) readonly buffer Table { RsAliasEntry table[]; };
layout(set = 0, binding = 2, scalar) writeonly buffer Out { uvec4 results[]; };

RsAliasEntry rsLoadAlias(uint column) { return table[column]; }

void main() {
    uint i = gl_GlobalInvocationID.x;
    RsRandom random = rsRandom(uvec2(i & 511u, i >> 9u), seed, stage);
    if (job == 0u) {
        uint a = rsNextBits(random), b = rsNextBits(random), index = rsNextIndex(random, count);
        results[i] = uvec4(a, b, index, floatBitsToUint(rsNext(random)));
    } else {
        uint a = rsSampleLight(count, random), b = rsSampleLight(count, random), c = rsSampleLight(count, random);
        results[i] = uvec4(a, b, c, rsSampleLight(count, random));
    }
}
