#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// One step of an edge-avoiding a-trous filter (Dammertz et al. 2010): neighbours on the same surface whose light differs by no
// more than noise does.
#include "include/denoise.glsl"

layout(set = 0, binding = 0, rgba32f) uniform readonly image2D geometryImage;
layout(set = 0, binding = 1, rg16_snorm) uniform readonly image2D normalImage;
layout(set = 0, binding = 2, rgba16f) uniform readonly image2D materialImage;
layout(set = 0, binding = 3, rgba32f) uniform readonly image2D fromDiffuseImage;
layout(set = 0, binding = 4, rgba32f) uniform readonly image2D fromSpecularImage;
layout(set = 0, binding = 5, rgba32f) uniform writeonly image2D toDiffuseImage;
layout(set = 0, binding = 6, rgba32f) uniform writeonly image2D toSpecularImage;

const float kNormalPower = 16.0;
const float kPlane = 0.01;       // off the plane that much of the depth counts as another surface
const float kDeviations = 4.0;   // of luminance
const float kLeastContrast = 0.01;   // relative: less is no edge
const float kReach = 60.0;       // pixels, of what a rough surface mirrors
const float kRoughness = 0.1;    // materials that differ so much mirror something else

// Variances are noisy themselves.
vec2 smoothVariance(ivec2 pixel) {
    vec2 sum = vec2(0.0);
    float weights = 0.0;
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
            ivec2 at = pixel + ivec2(x, y);
            if (!inside(at)) continue;
            float weight = float((2 - abs(x)) * (2 - abs(y)));
            sum += weight * vec2(imageLoad(fromDiffuseImage, at).w, imageLoad(fromSpecularImage, at).w);
            weights += weight;
        }
    return sum / weights;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (!inside(pixel)) return;
    vec4 geometry = imageLoad(geometryImage, pixel);
    if (geometry.w == 0.0) return;   // no surface
    vec4 diffuse = imageLoad(fromDiffuseImage, pixel), specular = imageLoad(fromSpecularImage, pixel);
    vec3 plane = decodeNormal(geometry.xy), position = positionAt(camera, pixel, geometry.z);
    vec3 normal = decodeNormal(imageLoad(normalImage, pixel).xy);
    float roughness = imageLoad(materialImage, pixel).x;
    vec2 light = vec2(luminance(diffuse.rgb), luminance(specular.rgb));
    vec2 tolerance = kDeviations * sqrt(smoothVariance(pixel)) + kLeastContrast * light + 1e-6;
    float reach = 1.0 + kReach * roughness;
    vec2 weights = vec2(1.0);
    const float kernel[3] = {1.0, 2.0 / 3.0, 1.0 / 6.0};
    for (int y = -2; y <= 2; ++y)
        for (int x = -2; x <= 2; ++x) {
            ivec2 offset = ivec2(x, y) * stride, at = pixel + offset;
            if (!inside(at) || (x == 0 && y == 0)) continue;
            vec4 other = imageLoad(geometryImage, at);
            if (other.w == 0.0) continue;
            float away = abs(dot(plane, positionAt(camera, at, other.z) - position)) / (kPlane * geometry.z);
            float same = kernel[abs(x)] * kernel[abs(y)] * exp(-away) *
                         pow(max(dot(normal, decodeNormal(imageLoad(normalImage, at).xy)), 0.0), kNormalPower);
            if (same < 1e-4) continue;
            vec4 d = imageLoad(fromDiffuseImage, at), s = imageLoad(fromSpecularImage, at);
            vec2 alike = exp(-abs(vec2(luminance(d.rgb), luminance(s.rgb)) - light) / tolerance);
            vec2 far = vec2(offset) / reach;
            float mirror = exp(-0.5 * dot(far, far) - abs(imageLoad(materialImage, at).x - roughness) / kRoughness);
            vec2 weight = same * alike * vec2(1.0, mirror);
            diffuse += vec4(weight.x * d.rgb, weight.x * weight.x * d.w);
            specular += vec4(weight.y * s.rgb, weight.y * weight.y * s.w);
            weights += weight;
        }
    imageStore(toDiffuseImage, pixel, diffuse / vec4(vec3(weights.x), weights.x * weights.x));
    imageStore(toSpecularImage, pixel, specular / vec4(vec3(weights.y), weights.y * weights.y));
}
