// The standard scene contract: what rays hit, and what the hits mean. A host with other structures replaces
// the bridge functions that read these (shaders/restir/bridge/standard.glsl).
#ifndef RESTIR_SHARED_SCENE_H
#define RESTIR_SHARED_SCENE_H
#include "restir/shared/types.h"
RS_SHARED_BEGIN

// One record per (instance, geometry). The record of a hit is instanceCustomIndex + geometryIndex.
struct RsInstance {
    RsAddress positions;   // float x 3 per vertex, object space, tightly packed
    RsAddress indices;     // uint32 x 3 per triangle, into the vertex streams
    RsAddress normals;     // float x 3 per vertex, object space; 0: geometric normals
    RsAddress uvs;         // float x 2 per vertex; 0: (0, 0)
    vec4 worldFromObject[3];   // rows of the affine transform, as in VkTransformMatrixKHR
    uint material;             // into the material buffer
    uint firstLight;           // light id of primitive 0, primitive i being firstLight + i; RS_NO_LIGHT: not a light
};

// glTF metallic-roughness. Textures are indices into SceneDesc::textures, RS_NO_TEXTURE for none; each
// multiplies its factor. Colours are linear once sampled (the host picks sRGB formats).
struct RsMaterial {
    vec4 baseColor;   // w: opacity, tested against alphaCutoff where RS_MATERIAL_ALPHA_MASK is set
    vec3 emission;    // radiance, W / (sr m^2)
    float roughness;  // perceptual, [0, 1]; times texture green
    float metalness;  // [0, 1]; times texture blue
    float specular;   // KHR_materials_specular's specularFactor, [0, 1]
    float normalScale;
    float alphaCutoff;
    uint baseColorTexture;
    uint metallicRoughnessTexture;
    uint normalTexture;
    uint emissionTexture;
    uint flags;   // RS_MATERIAL_*
};

RS_SHARED_END

#define RS_NO_LIGHT 0xffffffffu
#define RS_NO_TEXTURE 0xffffffffu

#define RS_MATERIAL_DOUBLE_SIDED 1u   // emits from both sides (Light::twoSided says it to the tables); shading is two-sided everywhere
#define RS_MATERIAL_ALPHA_MASK 2u     // rays pass where opacity < alphaCutoff

#endif
