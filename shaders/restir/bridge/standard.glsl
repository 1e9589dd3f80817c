// The standard bridge: what the SDK asks of a host, answered for the standard G-buffer, glTF-like materials and the
// scene set. A host's restir_bridge.glsl defines the guard and the function of what it replaces, then includes this
// file for the rest. With RS_BRIDGE_SCENE it brings its own set 1 and must replace all that reads it: BRIDGE_LIGHT,
// BRIDGE_TEXTURE, BRIDGE_OPAQUE.
#ifndef RESTIR_BRIDGE_STANDARD_GLSL
#define RESTIR_BRIDGE_STANDARD_GLSL
#include "restir/core/surface.glsl"
#include "restir/rays/hit.glsl"
#include "restir/shared/frame.h"
#include "restir/shared/scene.h"

#ifdef RS_PASS_EMITTERS
#include "restir/lights/emitter.glsl"
#endif

#ifndef RS_BRIDGE_BSDF
#include "restir/bsdf/metallic_roughness.glsl"
// BSDF times cosine towards the unit direction `light`, 1/sr.
vec3 rsBridgeBsdf(RsSurface s, vec3 light) { return rsBsdf(s, light); }
// A direction from three uniform numbers, and its density per solid angle.
vec3 rsBridgeSampleBsdf(RsSurface s, vec3 u) { return rsSampleBsdf(s, u); }
float rsBridgeBsdfPdf(RsSurface s, vec3 light) { return rsPdfBsdf(s, light); }
// The BSDF times cosine in the lobes of Output::diffuse and specular, each over its factor; only asked for where those
// are, or a checkerboard.
RsLobes rsBridgeLobes(RsSurface s, vec3 light) { return rsBsdfLobes(s, light); }
RsLobes rsBridgeLobeFactors(RsSurface s) { return RsLobes(rsDiffuseAlbedo(s), rsSpecularFactor(s)); }
#elif !defined(RS_BRIDGE_LOBES)
RsLobes rsBridgeLobes(RsSurface s, vec3 light) { return RsLobes(rsBridgeBsdf(s, light), vec3(0.0)); }   // all in one
RsLobes rsBridgeLobeFactors(RsSurface s) { return RsLobes(vec3(1.0), vec3(0.0)); }
#endif

#ifndef RS_BRIDGE_SCENE
#include "restir/bridge/scene.glsl"
#elif !defined(RS_BRIDGE_HIT)
// No indirect light.
RsSurface rsBridgeHit(RsHit hit, vec3 origin, vec3 direction) {
    RsSurface s;
    s.valid = false;
    return s;
}
#endif

#ifdef RS_PASS_EMITTERS
#if defined(RS_BRIDGE_TEXTURE) && !defined(RS_BRIDGE_TEXTURE_SIZE)
uvec2 rsBridgeTextureSize(uint index) { return uvec2(256u); }
#endif
#if defined(RS_BRIDGE_SCENE) && !defined(RS_BRIDGE_EMITTER)
RsEmitter rsBridgeEmitter(uint record, uint primitive) { return rsNoEmitter(); }
#endif
#endif

#ifdef RS_PASS_SURFACE
#ifndef RS_BRIDGE_SURFACE
#include "restir/bridge/gbuffer.glsl"
#endif
#endif

#endif
