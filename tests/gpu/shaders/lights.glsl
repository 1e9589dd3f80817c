#version 460
// Points of one light and what arrives from them at one receiver per invocation.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "restir/core/random.glsl"
#include "restir/lights/light.glsl"
#define HOOKS_ENVIRONMENT
#include "gpu/shaders/include/hooks.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) readonly buffer Parameters {
    uint seed, receivers;
    uint uniformly;      // else as the library draws
    uint width, height;  // of the environment
    RsPackedLight light;
};
layout(set = 0, binding = 1, scalar) readonly buffer Receivers { vec3 points[]; };   // used in turn
layout(set = 0, binding = 2, scalar) readonly buffer Environment { RsEnvironmentTexel texels[]; };
struct Result {
    uint uv;
    vec3 irradiance;
    vec3 direction;
    float distance;
    float solidAngle;
    float pdf;
    uint found;   // the point that is found in this one's direction; 0xffffffff: none
};
layout(set = 0, binding = 3, scalar) writeonly buffer Out { Result results[]; };

uvec2 rsEnvironmentExtent() { return uvec2(width, height); }
RsEnvironmentTexel rsLoadEnvironment(uint index) { return texels[index]; }

void main() {
    uint i = gl_GlobalInvocationID.x;
    RsRandom random = rsRandom(uvec2(i & 511u, i >> 9u), seed, 0u);
    vec3 receiver = points[i % receivers];
    float seen = rsSeenSolidAngle(light, receiver), drawn;
    uint uv = uniformly != 0u ? rsNextBits(random) : rsSampleLightUv(light, receiver, random, drawn);
    RsIncident incident = rsIncident(light, uv, receiver);
    float pdf = rsPdfLightUv(light, uv, incident, uniformly != 0u ? seen : drawn);
    uint found = 0xffffffffu;
    if (rsIsFoundByRays(light) && !rsFindAtInfinity(light, incident.direction, found)) found = 0xffffffffu;
    results[i] = Result(uv, incident.irradiance, incident.direction, incident.distance, incident.solidAngle, pdf, found);
}
