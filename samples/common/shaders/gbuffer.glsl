#version 460
#extension GL_GOOGLE_include_directive : require
// The host's G-buffer by primary rays: what a rasteriser would have written, jitter included.
#include "include/scene_trace.glsl"
#include "include/camera.glsl"

layout(set = 0, binding = 0) uniform writeonly image2D depthImage;
layout(set = 0, binding = 1) uniform writeonly image2D normalImage;
layout(set = 0, binding = 2) uniform writeonly image2D geometricNormalImage;
layout(set = 0, binding = 3) uniform writeonly image2D baseColorImage;
layout(set = 0, binding = 4) uniform writeonly image2D materialImage;
layout(set = 0, binding = 5) uniform writeonly image2D motionImage;
layout(set = 0, binding = 6) uniform writeonly image2D emissionImage;

layout(push_constant, scalar) uniform Constants {
    CameraPose camera;
    CameraPose previousCamera;
    uvec2 extent;
    vec2 jitter;   // pixels
};

const float kEmptyDepth = -1.0;
const float kLargestEmission = 65000.0;   // a half float's, and below what the SDK takes

vec4 encodeNormal(vec3 n) {
    vec2 e = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
    vec2 folded = (1.0 - abs(e.yx)) * mix(vec2(-1.0), vec2(1.0), greaterThanEqual(e, vec2(0.0)));
    return vec4(n.z < 0.0 ? folded : e, 0.0, 0.0);
}

void store(ivec2 at, Hit hit, vec3 direction, vec2 unjittered) {
    Surface s = sceneSurface(hit);
    RsMaterial material = sceneMaterials[s.material];
    imageStore(depthImage, at, vec4(dot(s.position - camera.eye, camera.forward)));
    imageStore(normalImage, at, encodeNormal(s.normal));
    imageStore(geometricNormalImage, at, encodeNormal(s.geometricNormal));
    imageStore(baseColorImage, at, vec4(sceneBaseColor(material, s.uv), 1.0));
    imageStore(materialImage, at, vec4(sceneGloss(material, s.uv), 0.0));
    vec2 before = cameraPixel(previousCamera, scenePreviousPosition(hit), vec2(extent));
    imageStore(motionImage, at, vec4(before - unjittered, 0.0, 0.0));
    imageStore(emissionImage, at, vec4(min(sceneEmission(s, -direction), vec3(kLargestEmission)), 0.0));
}

void storeEmpty(ivec2 at) {
    imageStore(depthImage, at, vec4(kEmptyDepth));
    imageStore(normalImage, at, vec4(0.0));
    imageStore(geometricNormalImage, at, vec4(0.0));
    imageStore(baseColorImage, at, vec4(0.0));
    imageStore(materialImage, at, vec4(0.0));
    imageStore(motionImage, at, vec4(0.0));
    imageStore(emissionImage, at, vec4(0.0));
}

void main() {
    uvec2 pixel = sceneThread();
    if (any(greaterThanEqual(pixel, extent))) return;
    vec2 unjittered = vec2(pixel) + 0.5 - jitter;
    vec3 direction = cameraDirection(camera, unjittered, vec2(extent));
    Hit hit = sceneTrace(camera.eye, direction, 1e30, gl_RayFlagsNoneEXT);
    if (hit.found) {
        store(ivec2(pixel), hit, direction, unjittered);
    } else {
        storeEmpty(ivec2(pixel));
    }
}
