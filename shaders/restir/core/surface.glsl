// A visible point as every pass but pass 0 knows it.
#ifndef RESTIR_CORE_SURFACE_GLSL
#define RESTIR_CORE_SURFACE_GLSL
#include "restir/core/math.glsl"
#include "restir/core/pack.glsl"
#include "restir/core/view.glsl"

// Both normals point to the viewer's side: surfaces are shaded from both sides.
struct RsSurface {
    bool valid;   // false: nothing visible here, the rest is undefined
    float depth;  // linear, along the view axis
    vec3 position;
    vec3 view;    // unit, towards the eye
    vec3 normal;
    vec3 geometricNormal;
    vec3 baseColor;
    float roughness;
    float metalness;
    float specular;
    uint materialId;
};

// What pass 0 learns from the host and only this frame needs.
struct RsSurfaceInput {
    RsSurface surface;   // position and view may be left undefined
    vec2 motion;         // previous minus current position in pixels
    vec3 emission;
};

// A BSDF times cosine in two lobes, each over a factor of its surface that its host can multiply again.
struct RsLobes {
    vec3 diffuse;
    vec3 specular;
};

struct RsPackedSurface {
    uvec4 geometry;   // depth, normal, geometric normal, base colour
    uvec2 material;   // roughness, metalness, specular, flags in 8 bits each; material id
};

RsPackedSurface rsPackSurface(RsSurface s) {
    if (!s.valid) return RsPackedSurface(uvec4(0u), uvec2(0u));
    return RsPackedSurface(uvec4(floatBitsToUint(s.depth), rsPackNormal(s.normal), rsPackNormal(s.geometricNormal),
                                 rsPackColor(s.baseColor)),
                           uvec2(packUnorm4x8(vec4(s.roughness, s.metalness, s.specular, 0.0)), s.materialId));
}

// Seen at `position` from `view`.
RsSurface rsUnpackSurface(RsPackedSurface p, vec3 position, vec3 view) {
    RsSurface s;
    s.depth = uintBitsToFloat(p.geometry.x);
    s.valid = s.depth > 0.0;
    s.position = position;
    s.view = view;
    s.normal = rsUnpackNormal(p.geometry.y);
    s.geometricNormal = rsUnpackNormal(p.geometry.z);
    s.baseColor = rsUnpackColor(p.geometry.w);
    vec4 material = rsUnpackUnorm8(p.material.x);
    s.roughness = material.x;
    s.metalness = material.y;
    s.specular = material.z;
    s.materialId = p.material.y;
    return s;
}

RsSurface rsUnpackSurface(RsPackedSurface p, RsView view, uvec2 extent, uvec2 pixel) {
    vec3 position = rsPositionFromDepth(view, extent, vec2(pixel) + 0.5, uintBitsToFloat(p.geometry.x));
    return rsUnpackSurface(p, position, rsTowardsEye(view, position));
}

// Turns both normals to the viewer and bends the shading normal where it faces away: interpolated and mapped normals
// do that at silhouettes.
void rsFaceViewer(inout RsSurface s) {
    if (dot(s.geometricNormal, s.view) < 0.0) s.geometricNormal = -s.geometricNormal;
    if (dot(s.normal, s.geometricNormal) < 0.0) s.normal = -s.normal;
    float facing = dot(s.normal, s.view);
    if (facing < 1e-3) s.normal = normalize(s.normal + (1e-3 - facing) * s.view);
}

#endif
