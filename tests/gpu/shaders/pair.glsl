#version 460
// Job 0: every pixel's partner, and that one's. Job 1: the notes of every pixel of a rough picture without lights.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "restir/di/pair_targets.glsl"
#include "gpu/shaders/include/hooks.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) readonly buffer Parameters {
    RsDiConstants di;
    uvec2 extent;
    uint job, seed, stage, index;
};
layout(set = 0, binding = 1, scalar) writeonly buffer Out { ivec4 partners[]; };
layout(set = 0, binding = 2, scalar) writeonly buffer Notes { uint notes[]; };   // one a word

// Steps of differently tilted patches, with holes.
RsSurface rsLoadSurface(uvec2 pixel) {
    uint patchBits = rsHash(pixel.x / 5u + rsHash(pixel.y / 7u + seed));
    float tilt = 0.3 * float(patchBits & 3u);
    RsSurface s;
    s.valid = (patchBits >> 8u & 15u) != 0u;
    s.depth = 1.0 + 0.02 * float(patchBits >> 2u & 7u);
    s.position = vec3(vec2(pixel) * 0.01, s.depth);
    s.normal = vec3(sin(tilt), 0.0, -cos(tilt));
    s.geometricNormal = s.normal;
    return s;
}
RsReservoir rsLoadSource(uvec2 pixel) { return rsEmptyReservoir(1u); }
void rsStoreNote(uvec2 pixel, uint number, uint note) {
    notes[(pixel.y * extent.x + pixel.x) * (di.neighbours + 1u) + number] = note;
}
RsPackedLight rsLoadLight(uint id) {
    RsPackedLight none;
    none.kindAndTexture = 0u;
    return none;
}
RsPackedLight rsLoadPreviousLight(uint id) { return rsLoadLight(id); }
vec3 rsBridgeBsdf(RsSurface s, vec3 light) { return vec3(0.0); }
bool rsOccluded(vec3 origin, vec3 direction, float tmax, bool previous) { return true; }

void main() {
    uint i = gl_GlobalInvocationID.x;
    uvec2 pixel = uvec2(i % extent.x, i / extent.x);
    if (pixel.y >= extent.y) return;
    if (job == 0u) {
        uint key = rsPartnerKey(seed, stage, index);
        // Far from the origin, so that every partner is a pixel.
        ivec2 far = ivec2(pixel) + ivec2(65536);
        ivec2 partner = rsPartner(uvec2(far), key, di.partnerSquare);
        partners[i] = ivec4(partner - far, rsPartner(uvec2(partner), key, di.partnerSquare) - far);
    } else {
        ivec2 partner = rsPartner(pixel, rsPartnerKey(seed, stage, index), di.partnerSquare);
        partners[i] = ivec4(partner, 0, 0);
        rsDiPairTargets(rsLoadSurface(pixel), RsPairing(pixel, extent, seed, stage), di);
    }
}
