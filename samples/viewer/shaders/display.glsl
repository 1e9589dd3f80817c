#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// What is shown of a frame: the SDK's light or a debug view, the reference on the right of a line; and for each 8x8 tile what
// the host wants to know of it.
#include "include/tone_map.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D radianceImage;
layout(set = 0, binding = 1, rgba32f) uniform readonly image2D debugImage;
layout(set = 0, binding = 2, rgba32f) uniform readonly image2D pathImage;   // the reference's paths of this frame
layout(set = 0, binding = 3, rgba32f) uniform image2D meanImage;            // of those of all frames since the last change
layout(set = 0, binding = 4) uniform writeonly image2D shownImage;

struct Tile {
    vec3 radiance;     // mean
    float error;       // sum over `pixels` of squares over those of the reference
    float reference;   // sum of its luminance
    float pixels;      // where it is not black
};
layout(set = 0, binding = 5, scalar) writeonly buffer Tiles { Tile tiles[]; };

layout(push_constant, scalar) uniform Constants {
    uvec2 extent;
    float exposure;
    float line;            // pixels from the left; the reference is shown beyond it
    uint showsDebug;
    uint referenceFrames;  // this one among them; 0: there is no reference
    float referenceMean;   // its mean luminance, as far as it is known
    uint firstTile;
};

shared vec3 sharedRadiance[64];
shared vec3 sharedError[64];   // error, reference, pixels

vec3 finite(vec3 color) { return any(isnan(color)) || any(isinf(color)) ? vec3(0.0) : max(color, vec3(0.0)); }

vec3 accumulate(ivec2 pixel) {
    vec3 path = finite(imageLoad(pathImage, pixel).rgb);
    if (referenceFrames > 1u) path = mix(imageLoad(meanImage, pixel).rgb, path, 1.0 / float(referenceFrames));
    imageStore(meanImage, pixel, vec4(path, 1.0));
    return path;
}

// As restir-bench measures it.
vec3 errorOf(vec3 radiance, vec3 reference) {
    float truth = luminance(reference), difference = luminance(radiance) - truth;
    if (truth <= 0.0) return vec3(0.0);
    float scale = truth * truth + 0.01 * referenceMean * referenceMean;
    return vec3(difference * difference / scale, truth, 1.0);
}

vec3 shownOf(ivec2 pixel, vec3 radiance, vec3 reference) {
    bool beyond = referenceFrames > 0u && float(pixel.x) >= line;
    if (showsDebug != 0u && !beyond) return imageLoad(debugImage, pixel).rgb;
    vec3 mapped = toneMap((beyond ? reference : radiance) * exposure);
    return vec3(encodeSrgb(mapped.x), encodeSrgb(mapped.y), encodeSrgb(mapped.z));
}

void writeTile() {
    Tile sum = Tile(vec3(0.0), 0.0, 0.0, 0.0);
    for (uint i = 0u; i < 64u; ++i) {
        sum.radiance += sharedRadiance[i] / 64.0;
        sum.error += sharedError[i].x;
        sum.reference += sharedError[i].y;
        sum.pixels += sharedError[i].z;
    }
    tiles[firstTile + gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x] = sum;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    vec3 radiance = vec3(0.0), error = vec3(0.0);
    if (all(lessThan(pixel, ivec2(extent)))) {
        radiance = finite(imageLoad(radianceImage, pixel).rgb);
        vec3 reference = vec3(0.0);
        if (referenceFrames > 0u) {
            reference = accumulate(pixel);
            error = errorOf(radiance, reference);
        }
        imageStore(shownImage, pixel, vec4(shownOf(pixel, radiance, reference), 1.0));
    }
    sharedRadiance[gl_LocalInvocationIndex] = radiance;
    sharedError[gl_LocalInvocationIndex] = error;
    barrier();
    if (gl_LocalInvocationIndex == 0u) writeTile();
}
