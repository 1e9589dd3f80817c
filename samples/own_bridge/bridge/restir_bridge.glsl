// The bridge of a host with a visibility buffer instead of a G-buffer, paints instead of glTF's materials and a
// descriptor set 1 of its own.
#define RS_BRIDGE_SURFACE
#define RS_BRIDGE_BSDF   // without RS_BRIDGE_LOBES: all that is reflected comes in Output::diffuse
#define RS_BRIDGE_SCENE
#define RS_BRIDGE_LIGHT
#define RS_BRIDGE_TEXTURE
#define RS_BRIDGE_OPAQUE
#define RS_BRIDGE_EMITTER
#include "restir/core/surface.glsl"
#include "restir/rays/hit.glsl"
#include "restir/shared/frame.h"
#include "restir/shared/scene.h"

// OwnPaint in host.h.
struct OwnPaint {
    vec3 color;
    float retro;   // how much more goes back where it came from, as from a road sign
    vec3 emission;
    uint twoSided;
};

layout(set = RS_SET_SCENE, binding = 0, scalar) readonly buffer OwnVisibility { uvec4 ownVisibility[]; };
layout(set = RS_SET_SCENE, binding = 1, scalar) readonly buffer OwnInstances { RsInstance ownInstances[]; };
layout(set = RS_SET_SCENE, binding = 2, scalar) readonly buffer OwnPaints { OwnPaint ownPaints[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer OwnPoints { vec3 at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer OwnIndices { uint at[]; };

// ---- materials: Lambert's, and a lobe back to where the light comes from ---------------------------

const float kOwnPi = 3.14159265;

float rsBridgeBsdfPdf(RsSurface s, vec3 light) { return max(dot(s.normal, light), 0.0) / kOwnPi; }
vec3 rsBridgeBsdf(RsSurface s, vec3 light) {
    OwnPaint paint = ownPaints[s.materialId];
    float back = pow(max(dot(s.view, light), 0.0), 16.0);
    return paint.color * (1.0 + paint.retro * back) * rsBridgeBsdfPdf(s, light);
}
vec3 rsBridgeSampleBsdf(RsSurface s, vec3 u) {
    float angle = 2.0 * kOwnPi * u.x;
    return rsBasis(s.normal) * vec3(sqrt(u.y) * vec2(cos(angle), sin(angle)), sqrt(1.0 - u.y));
}

// ---- what rays hit ---------------------------------------------------------------------------------

uint rsBridgeLight(RsHit hit) {
    uint first = ownInstances[hit.instance].firstLight;
    return first == RS_NO_LIGHT ? RS_NO_LIGHT : first + hit.primitive;
}
vec4 rsBridgeTexture(uint index, vec2 uv) { return vec4(1.0); }   // there are none
bool rsBridgeOpaque(RsHit hit) { return true; }

#include "restir/bridge/standard.glsl"

vec3 ownCorner(RsInstance instance, uint corner) {
    vec4 p = vec4(OwnPoints(instance.positions).at[OwnIndices(instance.indices).at[corner]], 1.0);
    return vec3(dot(instance.worldFromObject[0], p), dot(instance.worldFromObject[1], p), dot(instance.worldFromObject[2], p));
}

// ---- lights: whatever paint shines -----------------------------------------------------------------

#ifdef RS_PASS_EMITTERS
RsEmitter rsBridgeEmitter(uint record, uint primitive) {
    RsInstance instance = ownInstances[record];
    OwnPaint paint = ownPaints[instance.material];
    RsEmitter emitter = rsNoEmitter();
    for (uint i = 0u; i < 3u; ++i) emitter.corners[i] = ownCorner(instance, 3u * primitive + i);
    emitter.emission = paint.emission;
    emitter.twoSided = paint.twoSided != 0u;
    return emitter;
}
#endif

// ---- pass 0: a visible point from the triangle that a pixel shows --------------------------------------

#ifdef RS_PASS_SURFACE
RsSurfaceInput rsBridgeSurface(uvec2 pixel) {
    RsSurfaceInput result;
    result.motion = vec2(0.0);   // from the cameras
    result.emission = vec3(0.0);
    result.surface.valid = false;
    uvec4 visible = ownVisibility[pixel.y * rsFrame.extent.x + pixel.x];
    if (visible.x == 0u) return result;

    RsInstance instance = ownInstances[visible.x - 1u];
    vec3 a = ownCorner(instance, 3u * visible.y);
    vec3 u = ownCorner(instance, 3u * visible.y + 1u) - a, v = ownCorner(instance, 3u * visible.y + 2u) - a;
    vec2 at = uintBitsToFloat(visible.zw);
    vec3 position = a + at.x * u + at.y * v;
    vec3 normal = normalize(cross(u, v));
    OwnPaint paint = ownPaints[instance.material];

    RsSurface s;
    s.valid = true;
    s.depth = rsDepthOf(rsFrame.view, position);
    s.normal = normal;
    s.geometricNormal = normal;
    s.baseColor = paint.color;   // only kept; the BSDF asks for the paint
    s.roughness = 1.0;
    s.metalness = 0.0;
    s.specular = 0.0;
    s.materialId = instance.material;
    result.surface = s;
    if (paint.twoSided != 0u || dot(normal, rsFrame.view.eye - position) > 0.0) result.emission = paint.emission;
    return result;
}
#endif
