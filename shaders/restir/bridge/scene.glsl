// The standard scene set (restir/shared/scene.h) and the bridge functions that read it.
#ifndef RESTIR_BRIDGE_SCENE_GLSL
#define RESTIR_BRIDGE_SCENE_GLSL

layout(set = RS_SET_SCENE, binding = RS_SCENE_BIND_INSTANCES, scalar) readonly buffer RsInstances { RsInstance rsInstances[]; };
layout(set = RS_SET_SCENE, binding = RS_SCENE_BIND_MATERIALS, scalar) readonly buffer RsMaterials { RsMaterial rsMaterials[]; };
layout(set = RS_SET_SCENE, binding = RS_SCENE_BIND_TEXTURES) uniform sampler2D rsTextures[];

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer RsIndexStream { uint at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer RsUvStream { vec2 at[]; };

#ifndef RS_BRIDGE_TEXTURE
// Texture `index` of the scene, linear RGBA.
vec4 rsBridgeTexture(uint index, vec2 uv) { return textureLod(rsTextures[nonuniformEXT(index)], uv, 0.0); }
#endif

#ifndef RS_BRIDGE_LIGHT
uint rsBridgeLight(RsHit hit) {
    uint first = rsInstances[hit.instance].firstLight;
    return first == RS_NO_LIGHT ? RS_NO_LIGHT : first + hit.primitive;
}
#endif

#if !defined(RS_BRIDGE_OPAQUE) || (defined(RS_PASS_HITS) && !defined(RS_BRIDGE_HIT))
uvec3 rsHitCorners(RsInstance instance, RsHit hit) {
    RsIndexStream indices = RsIndexStream(instance.indices);
    uint i = 3u * hit.primitive;
    return uvec3(indices.at[i], indices.at[i + 1u], indices.at[i + 2u]);
}

vec2 rsHitUv(RsInstance instance, uvec3 corners, vec2 barycentrics) {
    if (all(equal(instance.uvs, uvec2(0u)))) return vec2(0.0);
    RsUvStream uvs = RsUvStream(instance.uvs);
    return (1.0 - barycentrics.x - barycentrics.y) * uvs.at[corners.x] + barycentrics.x * uvs.at[corners.y] +
           barycentrics.y * uvs.at[corners.z];
}
#endif

#ifndef RS_BRIDGE_OPAQUE
bool rsBridgeOpaque(RsHit hit) {
    RsInstance instance = rsInstances[hit.instance];
    uint m = instance.material;
    if ((rsMaterials[m].flags & RS_MATERIAL_ALPHA_MASK) == 0u) return true;
    float opacity = rsMaterials[m].baseColor.a;
    uint texture = rsMaterials[m].baseColorTexture;
    if (texture != RS_NO_TEXTURE) opacity *= rsBridgeTexture(texture, rsHitUv(instance, rsHitCorners(instance, hit), hit.barycentrics)).a;
    return opacity >= rsMaterials[m].alphaCutoff;
}
#endif

#if defined(RS_PASS_HITS) && !defined(RS_BRIDGE_HIT)
#include "restir/bridge/hit.glsl"
#endif

#endif
