// In the buffers of a restir::Bvh.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "common/shaders/include/trace_rays.glsl"
#include "restir/rays/software.glsl"

layout(set = 0, binding = 2, scalar) readonly buffer Nodes { uvec4 nodes[]; };
layout(set = 0, binding = 3, scalar) readonly buffer Corners0 { uvec4 corners0[]; };
layout(set = 0, binding = 4, scalar) readonly buffer Corners1 { uvec4 corners1[]; };
layout(set = 0, binding = 5, scalar) readonly buffer Corners2 { uvec4 corners2[]; };
layout(set = 0, binding = 6, scalar) readonly buffer Instances { uvec4 instances[]; };
layout(push_constant) uniform Push { uint rayCount, root, previousRoot, previous; };

uvec4 rsLoadBvhNode(uint vector) { return nodes[vector]; }
uint rsLoadBvhLink(uint vector) { return nodes[vector].w; }
uvec4 rsLoadBvhCorner(uint corner, uint triangle) {
    return corner == 0u ? corners0[triangle] : corner == 1u ? corners1[triangle] : corners2[triangle];
}
uvec4 rsLoadBvhInstance(uint vector) { return instances[vector]; }
uint rsBvhRoot(bool previous) { return previous ? previousRoot : root; }

void main() {
    uint i = sceneThreadIndex();
    if (i < rayCount) traceRay(i, previous != 0u);
}
