// The standard G-buffer (restir::GBuffer), read by pass 0 only.
#ifndef RESTIR_BRIDGE_GBUFFER_GLSL
#define RESTIR_BRIDGE_GBUFFER_GLSL

layout(set = RS_SET, binding = RS_BIND_DEPTH) uniform texture2D rsDepthImage;
layout(set = RS_SET, binding = RS_BIND_NORMAL) uniform texture2D rsNormalImage;
layout(set = RS_SET, binding = RS_BIND_GEOMETRIC_NORMAL) uniform texture2D rsGeometricNormalImage;
layout(set = RS_SET, binding = RS_BIND_BASE_COLOR) uniform texture2D rsBaseColorImage;
layout(set = RS_SET, binding = RS_BIND_MATERIAL) uniform texture2D rsMaterialImage;
layout(set = RS_SET, binding = RS_BIND_MOTION) uniform texture2D rsMotionImage;
layout(set = RS_SET, binding = RS_BIND_EMISSION) uniform texture2D rsEmissionImage;

vec3 rsDecodeNormal(vec3 stored, uint encoding) {
    if (encoding == RS_NORMAL_XYZ_UNORM || encoding == RS_NORMAL_OCTAHEDRAL_UNORM) stored = stored * 2.0 - 1.0;
    if (encoding == RS_NORMAL_OCTAHEDRAL || encoding == RS_NORMAL_OCTAHEDRAL_UNORM)
        return rsNormalFromOctahedral(stored.xy);
    return normalize(stored);
}

RsSurfaceInput rsBridgeSurface(uvec2 pixel) {
    RsSurfaceInput result;
    ivec2 at = ivec2(pixel + rsFrame.gbufferOrigin);
    float stored = texelFetch(rsDepthImage, at, 0).x;
    bool linear = (rsFrame.flags & RS_FRAME_LINEAR_DEPTH) != 0u;
    RsSurface s;
    s.depth = linear ? stored : rsDepthFromDevice(rsFrame.view, stored);
    s.normal = rsDecodeNormal(texelFetch(rsNormalImage, at, 0).xyz, rsFrame.normalEncoding);
    s.geometricNormal = s.normal;
    if ((rsFrame.flags & RS_FRAME_GEOMETRIC_NORMAL) != 0u)
        s.geometricNormal = rsDecodeNormal(texelFetch(rsGeometricNormalImage, at, 0).xyz, rsFrame.normalEncoding);
    s.valid = stored != rsFrame.emptyDepth;
    s.baseColor = rsSaturate(texelFetch(rsBaseColorImage, at, 0).rgb);
    vec3 material = vec3(1.0, 0.0, 1.0);
    if ((rsFrame.flags & RS_FRAME_MATERIAL) != 0u) material = texelFetch(rsMaterialImage, at, 0).rgb;
    s.roughness = rsSaturate(material.x);
    s.metalness = rsSaturate(material.y);
    s.specular = rsSaturate(material.z);
    s.materialId = 0u;
    result.surface = s;
    result.motion = vec2(0.0);
    if ((rsFrame.flags & RS_FRAME_MOTION) != 0u) result.motion = texelFetch(rsMotionImage, at, 0).xy * rsFrame.motionScale;
    result.emission = vec3(0.0);
    if ((rsFrame.flags & RS_FRAME_EMISSION) != 0u) result.emission = texelFetch(rsEmissionImage, at, 0).rgb;
    return result;
}

#endif
