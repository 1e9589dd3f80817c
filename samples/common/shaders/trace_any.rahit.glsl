#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_ray_tracing : require
#include "common/shaders/include/scene.glsl"

hitAttributeEXT vec2 barycentrics;

void main() {
    uint record = uint(gl_InstanceCustomIndexEXT + gl_GeometryIndexEXT);
    if (!sceneOpaque(record, uint(gl_PrimitiveID), barycentrics)) ignoreIntersectionEXT;
}
