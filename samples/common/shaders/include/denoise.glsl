// What the denoiser's passes have in common: a spatiotemporal filter guided by variance (Schied et al. 2017, SVGF).
#ifndef SAMPLES_DENOISE_GLSL
#define SAMPLES_DENOISE_GLSL
#include "include/camera.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(push_constant, scalar) uniform Constants {
    CameraPose camera;
    CameraPose previousCamera;
    ivec2 extent;
    uint flags;
    int stride;   // of the filter, pixels
};

const uint kHistory = 1u;    // there is a last frame
const uint kGradient = 2u;   // the gradient image says what changed
const uint kDirect = 4u;     // the lobes of direct light are there
const uint kIndirect = 8u;   // and those of indirect light

float luminance(vec3 c) { return dot(c, vec3(0.2126, 0.7152, 0.0722)); }

vec3 decodeNormal(vec2 e) {
    vec3 n = vec3(e, 1.0 - abs(e.x) - abs(e.y));
    float t = max(-n.z, 0.0);
    n.xy += mix(vec2(t), vec2(-t), greaterThanEqual(n.xy, vec2(0.0)));
    return normalize(n);
}

vec3 positionAt(CameraPose pose, ivec2 pixel, float depth) {
    return pose.eye + depth * cameraDirection(pose, vec2(pixel) + 0.5, vec2(extent));
}

bool inside(ivec2 pixel) { return all(greaterThanEqual(pixel, ivec2(0))) && all(lessThan(pixel, extent)); }

#endif
