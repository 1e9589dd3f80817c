#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// The lobes times what their surfaces reflect, as restir::Output says, and their emission; and what the next frame asks of this one.
#include "include/denoise.glsl"

layout(set = 0, binding = 0, rgba16f) uniform readonly image2D baseColorImage;
layout(set = 0, binding = 1, rgba16f) uniform readonly image2D materialImage;   // roughness, metalness, specular factor
layout(set = 0, binding = 2, rgba16f) uniform readonly image2D emissionImage;
layout(set = 0, binding = 3, rgba32f) uniform readonly image2D diffuseImage;
layout(set = 0, binding = 4, rgba32f) uniform readonly image2D specularImage;
layout(set = 0, binding = 5, rgba32f) uniform readonly image2D geometryImage;
layout(set = 0, binding = 6, rgba32f) uniform readonly image2D momentsImage;
layout(set = 0, binding = 7, rgba32f) uniform writeonly image2D oldGeometryImage;
layout(set = 0, binding = 8, rgba32f) uniform writeonly image2D oldMomentsImage;
layout(set = 0, binding = 9) uniform writeonly image2D pictureImage;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (!inside(pixel)) return;
    vec4 geometry = imageLoad(geometryImage, pixel);
    imageStore(oldGeometryImage, pixel, geometry);
    imageStore(oldMomentsImage, pixel, imageLoad(momentsImage, pixel));
    vec3 picture = vec3(0.0);
    if (geometry.w > 0.0) {
        vec3 color = imageLoad(baseColorImage, pixel).rgb, material = imageLoad(materialImage, pixel).rgb;
        vec3 factor = max(mix(vec3(0.04 * material.z), color, material.y), vec3(0.01));
        picture = imageLoad(emissionImage, pixel).rgb + imageLoad(diffuseImage, pixel).rgb * (1.0 - material.y) * color +
                  imageLoad(specularImage, pixel).rgb * factor;
    }
    imageStore(pictureImage, pixel, vec4(picture, 1.0));
}
