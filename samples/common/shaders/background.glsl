#version 460
#extension GL_GOOGLE_include_directive : require
// The environment map where a picture shows no surface: what a host draws around the SDK's light.
#include "include/camera.glsl"
#include "include/sky.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform writeonly image2D radianceImage;
layout(set = 0, binding = 1, r32f) uniform readonly image2D depthImage;

layout(push_constant, scalar) uniform Constants {
    CameraPose camera;
    uvec2 extent;
    vec2 jitter;   // pixels
};

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, ivec2(extent))) || imageLoad(depthImage, pixel).x >= 0.0) return;
    vec3 direction = cameraDirection(camera, vec2(pixel) + 0.5 - jitter, vec2(extent));
    imageStore(radianceImage, pixel, vec4(skyRadiance(direction), 1.0));
}
