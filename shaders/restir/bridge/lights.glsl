// The light tables in shaders of the host's own, of any stage: transparent surfaces, particles, fog, probes. Binds what
// LightTable::buffers() has, as storage buffers of set RS_LIGHTS_SET from binding RS_LIGHTS_BINDING on: lights, alias,
// environment. Needs GL_EXT_scalar_block_layout. The host defines, with the numbers of LightBuffers:
//     uint rsLightCount();
//     uvec2 rsEnvironmentExtent();
//     vec4 rsBridgeTexture(uint index, vec2 uv);   // the textures of its Scene, linear
// With RS_LIGHTS_TREE defined as a share in [0, 0.9], so much of the lights drawn are found by the tree (LightTableDesc::tree),
// which is bound behind the others: nearby lights among many are found far more often. As unbiased.
#ifndef RESTIR_BRIDGE_LIGHTS_GLSL
#define RESTIR_BRIDGE_LIGHTS_GLSL
#include "restir/lights/source.glsl"

#ifndef RS_LIGHTS_TREE
#define RS_LIGHTS_TREE 0.0
uvec4 rsLoadTreeNode(uint slot) { return uvec4(0u); }
uint rsLoadTreeWord(uint index) { return 0u; }
#else
layout(set = RS_LIGHTS_SET, binding = RS_LIGHTS_BINDING + 3, scalar) readonly buffer RsLightTree { uvec4 rsLightTree[]; };
uvec4 rsLoadTreeNode(uint slot) { return rsLightTree[slot]; }
uint rsLoadTreeWord(uint index) { return rsLightTree[index / 4u][index % 4u]; }
#endif

layout(set = RS_LIGHTS_SET, binding = RS_LIGHTS_BINDING, scalar) readonly buffer RsLights { RsPackedLight rsLights[]; };
layout(set = RS_LIGHTS_SET, binding = RS_LIGHTS_BINDING + 1, scalar) readonly buffer RsAlias { RsAliasEntry rsAlias[]; };
layout(set = RS_LIGHTS_SET, binding = RS_LIGHTS_BINDING + 2, scalar) readonly buffer RsEnvironmentTable {
    RsEnvironmentTexel at[];
} rsEnvironment;

uint rsLightCount();

RsAliasEntry rsLoadAlias(uint column) { return rsAlias[column]; }
RsPackedLight rsLoadLight(uint id) { return rsLights[id]; }
RsEnvironmentTexel rsLoadEnvironment(uint index) { return rsEnvironment.at[index]; }

struct RsDrawnLight {
    vec3 direction;    // unit, from the receiver to the light
    float distance;    // metres; RS_FAR for lights at infinity
    vec3 irradiance;   // on a plane that faces it, over its density, W / m^2; 0: nothing arrives
};

// A point of some light. For any f the mean of irradiance x visibility x f(direction) over many draws is what all lights
// bring: f is a BSDF times the cosine, a phase function, or the cosine alone, for the irradiance.
//
// `normal`: of the surface that only what is in front of it can light, unit; it finds less that is behind. 0: there is none.
RsDrawnLight rsDrawLight(vec3 receiver, vec3 normal, inout RsRandom random) {
    RsDrawnLight none = RsDrawnLight(vec3(0.0, 0.0, 1.0), 0.0, vec3(0.0));
    if (rsLightCount() == 0u) return none;
    RsLightSource source = rsSourceAt(RsLightSource(rsLightCount(), RS_LIGHTS_TREE), receiver);
    RsLightDraw draw = rsDrawLightFrom(source, receiver, normal, random);
    if (draw.light == RS_NO_LIGHT) return none;
    RsPackedLight light = rsLoadLight(draw.light);
    float seen;
    uint uv = rsSampleLightUv(light, receiver, random, seen);
    RsIncident incident = rsIncident(light, uv, receiver);
    float chance = rsLightChance(source, draw, light.selection, receiver, normal);
    float pdf = rsPdfLight(chance, light, uv, incident, seen);
    return pdf > 0.0 ? RsDrawnLight(incident.direction, incident.distance, incident.irradiance / pdf) : none;
}
RsDrawnLight rsDrawLight(vec3 receiver, inout RsRandom random) { return rsDrawLight(receiver, vec3(0.0), random); }

#endif
