#version 460
// Points of one light and what arrives from them at one receiver per invocation.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "restir/core/random.glsl"
#include "restir/lights/light.glsl"
#include "gpu/shaders/include/hooks.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) readonly buffer Parameters {
    uint seed, receivers;
    RsPackedLight light;
};
layout(set = 0, binding = 1, scalar) readonly buffer Receivers { vec3 points[]; };   // used in turn
struct Result {
    uint uv;
    vec3 irradiance;
    vec3 direction;
    float distance;
    float solidAngle;
};
layout(set = 0, binding = 2, scalar) writeonly buffer Out { Result results[]; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    RsRandom random = rsRandom(uvec2(i & 511u, i >> 9u), seed, 0u);
    uint uv = rsSampleLightUv(light, rsNextBits(random));
    RsIncident incident = rsIncident(light, uv, points[i % receivers]);
    results[i] = Result(uv, incident.irradiance, incident.direction, incident.distance, incident.solidAngle);
}
