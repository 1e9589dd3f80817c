#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_ray_tracing : require
#include "restir/rays/hit.glsl"

layout(location = 0) rayPayloadInEXT RsHit rsPayload;

void main() { rsPayload.t = -1.0; }
