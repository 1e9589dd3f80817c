#version 460
// The reconnection shift: one second vertex as two receivers see it.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "restir/bsdf/metallic_roughness.glsl"
#include "restir/gi/reservoir.glsl"
#include "gpu/shaders/include/hooks.glsl"

layout(local_size_x = 64) in;
struct Pair {
    vec3 from, to;   // receivers
    vec3 vertex, normal;
};
struct Seen {
    vec3 direction;
    float distance, solidAngle;
};
struct Result {
    Seen from, to;
    vec3 normal;   // as stored
};
layout(set = 0, binding = 0, scalar) readonly buffer In { Pair pairs[]; };
layout(set = 0, binding = 1, scalar) writeonly buffer Out { Result results[]; };

vec3 rsBridgeBsdf(RsSurface s, vec3 light) { return rsBsdf(s, light); }
bool rsWantsLobes() { return false; }
RsLobes rsBridgeLobes(RsSurface s, vec3 light) { return rsBsdfLobes(s, light); }
RsPackedLight rsLoadLight(uint id) {
    RsPackedLight light;
    light.kindAndTexture = RS_LIGHT_NONE;
    return light;
}
RsPackedLight rsLoadPreviousLight(uint id) { return rsLoadLight(id); }
RsAliasEntry rsLoadAlias(uint column) { return RsAliasEntry(0u, 0u); }
bool rsOccluded(vec3 origin, vec3 direction, float tmax, bool previous) { return false; }
void rsOnRejectedWeight() {}
float rsStaleShare() { return 1.0; }
bool rsStands(bool previous) { return true; }

Seen see(RsGiReservoir r, vec3 receiver) {
    RsIncident incident = rsSeeVertex(r, receiver);
    return Seen(incident.direction, incident.distance, incident.solidAngle);
}

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= pairs.length()) return;
    RsGiReservoir r = rsEmptyGiReservoir(1u);
    r.position = pairs[i].vertex;
    r.geometricNormal = rsPackNormal(pairs[i].normal);
    results[i] = Result(see(r, pairs[i].from), see(r, pairs[i].to), rsUnpackNormal(r.geometricNormal));
}
