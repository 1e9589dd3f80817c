// By a ray tracing pipeline, in the scene's own acceleration structure, then and now.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_ray_tracing : require
#define TRACE_BY_ADDRESS
#include "common/shaders/include/trace_rays.glsl"
#define rsTlas sceneTlas
#define rsPreviousTlas sceneTlas
#include "restir/rays/pipeline.glsl"

void main() {
    uint i = gl_LaunchIDEXT.y * gl_LaunchSizeEXT.x + gl_LaunchIDEXT.x;
    if (i < rayCount) traceRay(i, false);
}
