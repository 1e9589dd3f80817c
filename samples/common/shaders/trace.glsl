// By ray query or, with SCENE_RAYGEN, a ray tracing pipeline, in the scene's own acceleration structure, then and now.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "common/shaders/include/trace_rays.glsl"
#ifndef SCENE_RAYGEN
#extension GL_EXT_ray_query : require
#endif
layout(set = 1, binding = 0) uniform accelerationStructureEXT rsTlas;
#define rsPreviousTlas rsTlas
#ifdef SCENE_RAYGEN
#include "restir/rays/pipeline.glsl"
#else
#include "restir/rays/query.glsl"
#endif

layout(push_constant) uniform Push { uint rayCount; };

void main() {
    uint i = sceneThreadIndex();
    if (i < rayCount) traceRay(i, false);
}
