// The host's output image.
layout(set = RS_SET, binding = RS_BIND_RADIANCE) uniform writeonly image2D rsRadianceImage;

// Adds what the surface emits; empty pixels are 0.
void rsWriteRadiance(uvec2 pixel, vec3 direct) {
    vec3 emission = rsUnpackRadiance(rsSurfacesFrame[rsIndex(pixel)].y);
    imageStore(rsRadianceImage, ivec2(pixel + rsFrame.outputOrigin), vec4((emission + direct) * rsFrame.exposure, 1.0));
}
