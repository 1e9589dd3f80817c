// On geometry without the opaque flag: the bridge's alpha test.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/bindings.glsl"
#include "restir/rays/hit.glsl"

hitAttributeEXT vec2 rsBarycentrics;

void main() {
    RsHit candidate =
        RsHit(gl_HitTEXT, uint(gl_InstanceCustomIndexEXT + gl_GeometryIndexEXT), uint(gl_PrimitiveID), rsBarycentrics);
    if (!rsBridgeOpaque(candidate)) ignoreIntersectionEXT;
}
