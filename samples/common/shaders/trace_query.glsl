// By ray query, in the scene's own acceleration structure, then and now.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "common/shaders/include/trace_rays.glsl"
#define rsTlas sceneTlas
#define rsPreviousTlas sceneTlas
#include "restir/rays/query.glsl"

layout(push_constant) uniform Push { uint rayCount; };

void main() {
    uint i = rayOfInvocation();
    if (i < rayCount) traceRay(i, false);
}
