// The scene as GpuScene binds it (set 1): attributes of a hit and its material.
#ifndef SAMPLES_SCENE_GLSL
#define SAMPLES_SCENE_GLSL
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require
#extension GL_EXT_nonuniform_qualifier : require
#extension GL_EXT_scalar_block_layout : require
#include "restir/shared/scene.h"

layout(set = 1, binding = 1, scalar) readonly buffer SceneInstances { RsInstance sceneInstances[]; };
layout(set = 1, binding = 2, scalar) readonly buffer SceneMaterials { RsMaterial sceneMaterials[]; };
// Rows of last frame's worldFromObject, three for each record.
layout(set = 1, binding = 4, scalar) readonly buffer ScenePreviousTransforms { vec4 scenePreviousTransforms[]; };
layout(set = 1, binding = 6) uniform sampler2D sceneTextures[];   // 0: scene_trace.glsl, 5: sky.glsl

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Vectors { vec3 at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Coordinates { vec2 at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Indices { uint at[]; };

struct Hit {
    bool found;
    uint record;      // of the instance and geometry, in sceneInstances
    uint primitive;
    vec2 barycentrics;
};

// World space. The triangle's own winding decides its front; nothing is flipped towards the viewer.
struct Surface {
    vec3 position;
    vec3 edge1, edge2;        // of the triangle
    vec3 geometricNormal;     // unit, front side
    vec3 normal;              // interpolated and normal-mapped
    vec2 uv;
    uint material;
};

bool sceneHas(uvec2 address) { return (address.x | address.y) != 0u; }

uvec3 sceneCorners(RsInstance instance, uint primitive) {
    Indices indices = Indices(instance.indices);
    uint first = 3u * primitive;
    return uvec3(indices.at[first], indices.at[first + 1u], indices.at[first + 2u]);
}

vec3 scenePoint(RsInstance instance, vec3 p) {
    vec4 point = vec4(p, 1.0);
    return vec3(dot(instance.worldFromObject[0], point), dot(instance.worldFromObject[1], point),
                dot(instance.worldFromObject[2], point));
}

// By the inverse transpose up to a positive factor, so that mirrored instances keep their side.
vec3 sceneNormal(RsInstance instance, vec3 n) {
    vec3 x = instance.worldFromObject[0].xyz;
    vec3 y = instance.worldFromObject[1].xyz;
    vec3 z = instance.worldFromObject[2].xyz;
    vec3 yz = cross(y, z);
    vec3 scaled = vec3(dot(yz, n), dot(cross(z, x), n), dot(cross(x, y), n));
    return dot(x, yz) < 0.0 ? -scaled : scaled;
}

vec2 sceneUv(RsInstance instance, uvec3 corners, vec3 weights) {
    if (!sceneHas(instance.uvs)) return vec2(0.0);
    Coordinates uvs = Coordinates(instance.uvs);
    return weights.x * uvs.at[corners.x] + weights.y * uvs.at[corners.y] + weights.z * uvs.at[corners.z];
}

vec4 sceneTexture(uint index, vec2 uv) { return textureLod(sceneTextures[nonuniformEXT(index)], uv, 0.0); }

vec3 sceneSafeNormal(vec3 n, vec3 fallback) {
    float lengthSquared = dot(n, n);
    return lengthSquared > 0.0 ? n * inversesqrt(lengthSquared) : fallback;
}

// glTF's +Y of a normal map points up the image, against v.
vec3 sceneMappedNormal(RsMaterial material, Surface s, RsInstance instance, uvec3 corners) {
    if (material.normalTexture == RS_NO_TEXTURE || !sceneHas(instance.uvs)) return s.normal;
    Coordinates uvs = Coordinates(instance.uvs);
    vec2 uv0 = uvs.at[corners.x];
    vec2 d1 = uvs.at[corners.y] - uv0, d2 = uvs.at[corners.z] - uv0;
    float area = d1.x * d2.y - d2.x * d1.y;
    if (area == 0.0) return s.normal;
    vec3 alongU = (s.edge1 * d2.y - s.edge2 * d1.y) * sign(area);
    vec3 alongV = (s.edge2 * d1.x - s.edge1 * d2.x) * sign(area);
    vec3 tangent = alongU - s.normal * dot(s.normal, alongU);
    if (dot(tangent, tangent) == 0.0) return s.normal;
    tangent = normalize(tangent);
    vec3 bitangent = cross(s.normal, tangent);
    if (dot(bitangent, alongV) > 0.0) bitangent = -bitangent;
    vec3 local = 2.0 * sceneTexture(material.normalTexture, s.uv).xyz - 1.0;
    local.xy *= material.normalScale;
    return sceneSafeNormal(tangent * local.x + bitangent * local.y + s.normal * local.z, s.normal);
}

Surface sceneSurface(Hit hit) {
    RsInstance instance = sceneInstances[hit.record];
    uvec3 corners = sceneCorners(instance, hit.primitive);
    Vectors positions = Vectors(instance.positions);
    vec3 p0 = scenePoint(instance, positions.at[corners.x]);
    vec3 weights = vec3(1.0 - hit.barycentrics.x - hit.barycentrics.y, hit.barycentrics);
    Surface s;
    s.edge1 = scenePoint(instance, positions.at[corners.y]) - p0;
    s.edge2 = scenePoint(instance, positions.at[corners.z]) - p0;
    s.position = p0 + weights.y * s.edge1 + weights.z * s.edge2;
    s.geometricNormal = sceneSafeNormal(cross(s.edge1, s.edge2), vec3(0.0, 0.0, 1.0));
    s.normal = s.geometricNormal;
    if (sceneHas(instance.normals)) {
        Vectors normals = Vectors(instance.normals);
        vec3 n = weights.x * normals.at[corners.x] + weights.y * normals.at[corners.y] +
                 weights.z * normals.at[corners.z];
        s.normal = sceneSafeNormal(sceneNormal(instance, n), s.geometricNormal);
    }
    s.uv = sceneUv(instance, corners, weights);
    s.material = instance.material;
    s.normal = sceneMappedNormal(sceneMaterials[s.material], s, instance, corners);
    return s;
}

// Where the point that was hit was a frame ago.
vec3 scenePreviousPosition(Hit hit) {
    RsInstance instance = sceneInstances[hit.record];
    for (uint row = 0u; row < 3u; ++row) instance.worldFromObject[row] = scenePreviousTransforms[3u * hit.record + row];
    uvec3 corners = sceneCorners(instance, hit.primitive);
    Vectors positions = Vectors(instance.positions);
    vec3 p0 = scenePoint(instance, positions.at[corners.x]);
    return p0 + hit.barycentrics.x * (scenePoint(instance, positions.at[corners.y]) - p0) +
           hit.barycentrics.y * (scenePoint(instance, positions.at[corners.z]) - p0);
}

vec3 sceneBaseColor(RsMaterial material, vec2 uv) {
    vec3 color = material.baseColor.rgb;
    if (material.baseColorTexture != RS_NO_TEXTURE) color *= sceneTexture(material.baseColorTexture, uv).rgb;
    return clamp(color, 0.0, 1.0);
}

// x roughness, y metalness, z specular.
vec3 sceneGloss(RsMaterial material, vec2 uv) {
    vec3 gloss = vec3(material.roughness, material.metalness, material.specular);
    if (material.metallicRoughnessTexture != RS_NO_TEXTURE) {
        gloss.xy *= sceneTexture(material.metallicRoughnessTexture, uv).gb;
    }
    return clamp(gloss, 0.0, 1.0);
}

// Radiance leaving the surface in a direction; from the front only, unless the material is double-sided.
vec3 sceneEmission(Surface s, vec3 direction) {
    RsMaterial material = sceneMaterials[s.material];
    bool front = dot(cross(s.edge1, s.edge2), direction) > 0.0;
    if (!front && (material.flags & RS_MATERIAL_DOUBLE_SIDED) == 0u) return vec3(0.0);
    vec3 emission = material.emission;
    if (material.emissionTexture != RS_NO_TEXTURE && emission != vec3(0.0)) {
        emission *= sceneTexture(material.emissionTexture, s.uv).rgb;
    }
    return emission;
}

bool sceneOpaque(uint record, uint primitive, vec2 barycentrics) {
    RsInstance instance = sceneInstances[record];
    RsMaterial material = sceneMaterials[instance.material];
    if ((material.flags & RS_MATERIAL_ALPHA_MASK) == 0u) return true;
    float opacity = material.baseColor.w;
    if (material.baseColorTexture != RS_NO_TEXTURE) {
        vec3 weights = vec3(1.0 - barycentrics.x - barycentrics.y, barycentrics);
        vec2 uv = sceneUv(instance, sceneCorners(instance, primitive), weights);
        opacity *= sceneTexture(material.baseColorTexture, uv).a;
    }
    return opacity >= material.alphaCutoff;
}

#endif
