#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_ray_tracing : require
#include "restir/rays/hit.glsl"

layout(location = 0) rayPayloadInEXT RsHit rsPayload;
hitAttributeEXT vec2 rsBarycentrics;

void main() {
    rsPayload = RsHit(gl_HitTEXT, uint(gl_InstanceCustomIndexEXT + gl_GeometryIndexEXT), uint(gl_PrimitiveID), rsBarycentrics);
}
