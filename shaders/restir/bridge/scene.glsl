// The standard scene set (restir/shared/scene.h) and the bridge functions that read it.
#ifndef RESTIR_BRIDGE_SCENE_GLSL
#define RESTIR_BRIDGE_SCENE_GLSL

layout(set = RS_SET_SCENE, binding = RS_SCENE_BIND_INSTANCES, scalar) readonly buffer RsInstances { RsInstance rsInstances[]; };
layout(set = RS_SET_SCENE, binding = RS_SCENE_BIND_MATERIALS, scalar) readonly buffer RsMaterials { RsMaterial rsMaterials[]; };
layout(set = RS_SET_SCENE, binding = RS_SCENE_BIND_TEXTURES) uniform sampler2D rsTextures[];

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer RsIndexStream { uint at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer RsUvStream { vec2 at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer RsVectorStream { vec3 at[]; };

#ifndef RS_BRIDGE_TEXTURE
// Texture `index` of the scene, linear RGBA.
vec4 rsBridgeTexture(uint index, vec2 uv) { return textureLod(rsTextures[nonuniformEXT(index)], uv, 0.0); }
#ifdef RS_PASS_EMITTERS
uvec2 rsBridgeTextureSize(uint index) { return uvec2(textureSize(rsTextures[nonuniformEXT(index)], 0)); }
#endif
#endif

#ifndef RS_BRIDGE_LIGHT
uint rsBridgeLight(RsHit hit) {
    uint first = rsInstances[hit.instance].firstLight;
    return first == RS_NO_LIGHT ? RS_NO_LIGHT : first + hit.primitive;
}
#endif

uvec3 rsCorners(RsInstance instance, uint primitive) {
    RsIndexStream indices = RsIndexStream(instance.indices);
    uint i = 3u * primitive;
    return uvec3(indices.at[i], indices.at[i + 1u], indices.at[i + 2u]);
}

vec3 rsWorldPoint(RsInstance instance, vec3 p) {
    vec4 q = vec4(p, 1.0);
    return vec3(dot(instance.worldFromObject[0], q), dot(instance.worldFromObject[1], q), dot(instance.worldFromObject[2], q));
}

vec2 rsHitUv(RsInstance instance, uvec3 corners, vec2 barycentrics) {
    if (all(equal(instance.uvs, uvec2(0u)))) return vec2(0.0);
    RsUvStream uvs = RsUvStream(instance.uvs);
    return (1.0 - barycentrics.x - barycentrics.y) * uvs.at[corners.x] + barycentrics.x * uvs.at[corners.y] +
           barycentrics.y * uvs.at[corners.z];
}

#ifndef RS_BRIDGE_OPAQUE
bool rsBridgeOpaque(RsHit hit) {
    RsInstance instance = rsInstances[hit.instance];
    uint m = instance.material;
    if ((rsMaterials[m].flags & RS_MATERIAL_ALPHA_MASK) == 0u) return true;
    float opacity = rsMaterials[m].baseColor.a;
    uint texture = rsMaterials[m].baseColorTexture;
    if (texture != RS_NO_TEXTURE) opacity *= rsBridgeTexture(texture, rsHitUv(instance, rsCorners(instance, hit.primitive), hit.barycentrics)).a;
    return opacity >= rsMaterials[m].alphaCutoff;
}
#endif

#if defined(RS_PASS_HITS) && !defined(RS_BRIDGE_HIT)
#include "restir/bridge/hit.glsl"
#endif

#if defined(RS_PASS_EMITTERS) && !defined(RS_BRIDGE_EMITTER)
// Triangle `primitive` of record `record`, whatever it emits.
RsEmitter rsBridgeEmitter(uint record, uint primitive) {
    RsInstance instance = rsInstances[record];
    RsMaterial material = rsMaterials[instance.material];
    uvec3 corners = rsCorners(instance, primitive);
    RsVectorStream positions = RsVectorStream(instance.positions);
    RsUvStream uvs = RsUvStream(instance.uvs);
    bool hasUvs = any(notEqual(instance.uvs, uvec2(0u)));
    RsEmitter emitter;
    for (int i = 0; i < 3; ++i) {
        emitter.corners[i] = rsWorldPoint(instance, positions.at[corners[i]]);
        emitter.uvs[i] = hasUvs ? uvs.at[corners[i]] : vec2(0.0);
    }
    emitter.emission = material.emission;
    emitter.texture = material.emissionTexture;
    emitter.twoSided = (material.flags & RS_MATERIAL_DOUBLE_SIDED) != 0u;
    return emitter;
}
#endif

#endif
