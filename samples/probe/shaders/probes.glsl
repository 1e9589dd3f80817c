#version 460
#extension GL_GOOGLE_include_directive : require
// The irradiance of each probe by lights drawn from restir's tables, with a shadow ray to each.
#include "include/scene_trace.glsl"
layout(push_constant, scalar) uniform Constants {
    uvec2 environmentExtent;
    uint lightCount, probeCount, draws, seed;
    float treeShare;
};
#define RS_LIGHTS_SET 0
#define RS_LIGHTS_BINDING 0
#define RS_LIGHTS_TREE treeShare
#include "restir/bridge/lights.glsl"


struct Probe {   // in probes.h
    vec3 position, normal, irradiance;
};
layout(set = 0, binding = 4, scalar) buffer Probes { Probe probes[]; };

uint rsLightCount() { return lightCount; }
uvec2 rsEnvironmentExtent() { return environmentExtent; }
vec4 rsBridgeTexture(uint index, vec2 uv) { return sceneTexture(index, uv); }

void main() {
    uint i = sceneThreadIndex();
    if (i >= probeCount) return;
    Probe probe = probes[i];
    RsRandom random = rsRandom(uvec2(i, 0u), seed, 0u);
    vec3 sum = vec3(0.0);
    for (uint k = 0u; k < draws; ++k) {
        RsDrawnLight light = rsDrawLight(probe.position, probe.normal, random);
        bool hasPlane = probe.normal != vec3(0.0);   // else it is in fog: light from all around counts
        vec3 arrives = light.irradiance * (hasPlane ? dot(probe.normal, light.direction) : 1.0);
        if (!any(greaterThan(arrives, vec3(0.0)))) continue;
        float end = min(light.distance, 1e6) * 0.999;   // short of the light, which may be a triangle
        if (!sceneTrace(probe.position, light.direction, end, gl_RayFlagsTerminateOnFirstHitEXT).found) sum += arrives;
    }
    probes[i].irradiance = sum / float(draws);
}
