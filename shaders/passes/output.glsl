// The host's output images. Empty pixels are 0.
#include "passes/lit.glsl"

layout(set = RS_SET, binding = RS_BIND_RADIANCE) uniform writeonly image2D rsRadianceImage;
layout(set = RS_SET, binding = RS_BIND_DIFFUSE) uniform writeonly image2D rsDiffuseImage;
layout(set = RS_SET, binding = RS_BIND_SPECULAR) uniform writeonly image2D rsSpecularImage;

vec4 rsLobeOutput(vec4 sum) { return vec4(sum.rgb * rsFrame.exposure, rsMeanDistance(sum)); }

// What di.fill takes from the pixels that a checkerboard lights, in place of motion and emission, which these need no more.
void rsStoreLit(uvec2 pixel, RsShading shading) { rsSurfacesFrame[rsIndex(pixel)] = rsPackLit(shading); }
RsLobes rsLoadLit(uvec2 pixel) { return rsUnpackLit(rsSurfacesFrame[rsIndex(pixel)]); }

// Radiance contains what the surface emits, the lobes do not.
void rsWriteOutputs(uvec2 pixel, RsShading shading) {
    ivec2 at = ivec2(pixel + rsFrame.outputOrigin);
    imageStore(rsRadianceImage, at, vec4((rsLoadOwnLight(pixel) + shading.radiance) * rsFrame.exposure, 1.0));
    if ((rsFrame.flags & RS_FRAME_DIFFUSE) != 0u) imageStore(rsDiffuseImage, at, rsLobeOutput(shading.diffuse));
    if ((rsFrame.flags & RS_FRAME_SPECULAR) != 0u) imageStore(rsSpecularImage, at, rsLobeOutput(shading.specular));
    if (rsFrame.di.field != RS_FIELD_ALL) rsStoreLit(pixel, shading);
}
