#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// The mean of what the same surface received in this frame and the last ones, and how much single frames vary about it.
#include "include/denoise.glsl"

layout(set = 0, binding = 0, r32f) uniform readonly image2D depthImage;
layout(set = 0, binding = 1, rg16_snorm) uniform readonly image2D normalImage;   // geometric: bumps need not be where they were, to the pixel
layout(set = 0, binding = 2, rg32f) uniform readonly image2D motionImage;
layout(set = 0, binding = 3, rgba32f) uniform readonly image2D diffuseImage;
layout(set = 0, binding = 4, rgba32f) uniform readonly image2D specularImage;
layout(set = 0, binding = 5, rgba32f) uniform readonly image2D indirectDiffuseImage;
layout(set = 0, binding = 6, rgba32f) uniform readonly image2D indirectSpecularImage;
layout(set = 0, binding = 7, rgba32f) uniform readonly image2D gradientImage;
layout(set = 0, binding = 8, rgba32f) uniform readonly image2D oldGeometryImage;
layout(set = 0, binding = 9, rgba32f) uniform readonly image2D oldMomentsImage;
layout(set = 0, binding = 10, rgba32f) uniform readonly image2D oldDiffuseImage;
layout(set = 0, binding = 11, rgba32f) uniform readonly image2D oldSpecularImage;
layout(set = 0, binding = 12, rgba32f) uniform writeonly image2D geometryImage;   // xy geometric normal, z depth, w frames
layout(set = 0, binding = 13, rgba32f) uniform writeonly image2D momentsImage;    // of luminance: diffuse, specular
layout(set = 0, binding = 14, rgba32f) uniform writeonly image2D meanDiffuseImage;   // w: variance
layout(set = 0, binding = 15, rgba32f) uniform writeonly image2D meanSpecularImage;

const float kMostFrames = 24.0;
const float kLeastCosine = 0.9, kLargestDepthStep = 0.1;   // of what counts as the same surface
const float kFramesForVariance = 4.0;   // fewer say nothing of it: neighbours do

struct Light {
    vec3 diffuse, specular;
};

Light lightAt(ivec2 pixel) {
    Light light = Light(vec3(0.0), vec3(0.0));
    if ((flags & kDirect) != 0u) {
        light.diffuse += imageLoad(diffuseImage, pixel).rgb;
        light.specular += imageLoad(specularImage, pixel).rgb;
    }
    if ((flags & kIndirect) != 0u) {
        light.diffuse += imageLoad(indirectDiffuseImage, pixel).rgb;
        light.specular += imageLoad(indirectSpecularImage, pixel).rgb;
    }
    return Light(max(light.diffuse, vec3(0.0)), max(light.specular, vec3(0.0)));
}

// The last frame's mean at the place where this surface was; w of `diffuse`: 0 if it was not seen.
struct Past {
    vec3 diffuse, specular;
    vec4 moments;
    float frames;
};

Past pastOf(ivec2 pixel, vec3 normal, float depth) {
    Past past = Past(vec3(0.0), vec3(0.0), vec4(0.0), 0.0);
    if ((flags & kHistory) == 0u) return past;
    vec2 before = vec2(pixel) + imageLoad(motionImage, pixel).xy;
    ivec2 corner = ivec2(floor(before));
    vec2 part = before - vec2(corner);
    float expected = dot(positionAt(camera, pixel, depth) - previousCamera.eye, previousCamera.forward), sum = 0.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 offset = ivec2(i & 1, i >> 1), at = corner + offset;
        if (!inside(at)) continue;
        vec4 geometry = imageLoad(oldGeometryImage, at);
        if (geometry.w == 0.0 || abs(geometry.z - expected) > kLargestDepthStep * expected ||
            dot(decodeNormal(geometry.xy), normal) < kLeastCosine)
            continue;
        vec2 share = mix(1.0 - part, part, vec2(offset));
        float weight = share.x * share.y;
        past.diffuse += weight * imageLoad(oldDiffuseImage, at).rgb;
        past.specular += weight * imageLoad(oldSpecularImage, at).rgb;
        past.moments += weight * imageLoad(oldMomentsImage, at);
        past.frames += weight * geometry.w;
        sum += weight;
    }
    if (sum < 0.01) return Past(vec3(0.0), vec3(0.0), vec4(0.0), 0.0);
    return Past(past.diffuse / sum, past.specular / sum, past.moments / sum, past.frames / sum);
}

// The share of light around that changed since the last frame.
float changed(ivec2 pixel) {
    if ((flags & kGradient) == 0u) return 0.0;
    vec2 sum = vec2(0.0);
    for (int y = -4; y <= 4; y += 2)
        for (int x = -4; x <= 4; x += 2)
            if (inside(pixel + ivec2(x, y))) sum += imageLoad(gradientImage, pixel + ivec2(x, y)).zw;
    return sum.y > 0.0 ? clamp(sum.x / sum.y, 0.0, 1.0) : 0.0;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (!inside(pixel)) return;
    float depth = imageLoad(depthImage, pixel).x;
    vec2 packedNormal = imageLoad(normalImage, pixel).xy;
    if (!(depth >= 0.0)) {
        imageStore(geometryImage, pixel, vec4(0.0));
        imageStore(momentsImage, pixel, vec4(0.0));
        imageStore(meanDiffuseImage, pixel, vec4(0.0));
        imageStore(meanSpecularImage, pixel, vec4(0.0));
        return;
    }
    // No brighter than the brightest of its neighbours: single pixels are noise.
    Light now = lightAt(pixel);
    vec2 most = vec2(0.0), mean = vec2(0.0), square = vec2(0.0);
    float around = 0.0;
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
            ivec2 at = pixel + ivec2(x, y);
            if (!inside(at) || (x == 0 && y == 0)) continue;
            Light light = lightAt(at);
            vec2 l = vec2(luminance(light.diffuse), luminance(light.specular));
            most = max(most, l);
            mean += l;
            square += l * l;
            around += 1.0;
        }
    vec2 bright = vec2(luminance(now.diffuse), luminance(now.specular));
    vec2 scale = min(vec2(1.0), most / max(bright, vec2(1e-20)));
    now.diffuse *= scale.x;
    now.specular *= scale.y;
    bright *= scale;

    Past past = pastOf(pixel, decodeNormal(packedNormal), depth);
    float gone = changed(pixel);
    float frames = min(past.frames * (1.0 - gone) + 1.0, kMostFrames);
    float fresh = 1.0 / frames;
    vec4 moments = mix(past.moments, vec4(bright.x, bright.x * bright.x, bright.y, bright.y * bright.y), fresh);
    vec2 variance = max(moments.yw - moments.xz * moments.xz, vec2(0.0));
    if (frames < kFramesForVariance && around > 0.0) {
        mean /= around;
        variance = max(variance, max(square / around - mean * mean, vec2(0.0)) * (kFramesForVariance / frames));
    }
    imageStore(geometryImage, pixel, vec4(packedNormal, depth, frames));
    imageStore(momentsImage, pixel, moments);
    imageStore(meanDiffuseImage, pixel, vec4(mix(past.diffuse, now.diffuse, fresh), variance.x));
    imageStore(meanSpecularImage, pixel, vec4(mix(past.specular, now.specular, fresh), variance.y));
}
