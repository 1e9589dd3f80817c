#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "restir/shared/types.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) buffer Out { uint value[]; };

void main() {
    value[gl_GlobalInvocationID.x] = gl_GlobalInvocationID.x;
}
