#version 460
#extension GL_GOOGLE_include_directive : require
// The host's visibility buffer by primary rays: 0 or 1 + record, triangle, barycentrics.
#include "include/scene_trace.glsl"
#include "include/camera.glsl"

layout(set = 0, binding = 0, scalar) writeonly buffer Visibility { uvec4 visibility[]; };

layout(push_constant, scalar) uniform Constants {
    CameraPose camera;
    uvec2 extent;
};

void main() {
    uvec2 pixel = sceneThread();
    if (any(greaterThanEqual(pixel, extent))) return;
    vec3 direction = cameraDirection(camera, vec2(pixel) + 0.5, vec2(extent));
    Hit hit = sceneTrace(camera.eye, direction, 1e30, gl_RayFlagsNoneEXT);
    uvec4 seen = uvec4(hit.record + 1u, hit.primitive, floatBitsToUint(hit.barycentrics));
    visibility[pixel.y * extent.x + pixel.x] = hit.found ? seen : uvec4(0u);
}
