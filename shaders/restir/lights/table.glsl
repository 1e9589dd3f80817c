// Drawing a light by power in O(1) (alias method: Walker 1977, Vose 1991; restir/lights/alias.glsl builds the table).
// The includer provides the table and the lights:
#ifndef RESTIR_LIGHTS_TABLE_GLSL
#define RESTIR_LIGHTS_TABLE_GLSL
#include "restir/core/random.glsl"
#include "restir/lights/light.glsl"

RsAliasEntry rsLoadAlias(uint column);
RsPackedLight rsLoadLight(uint id);           // RS_LIGHT_NONE for ids that name nothing this frame
RsPackedLight rsLoadPreviousLight(uint id);   // as in the last frame

// A power of two, at least 2, and not fewer than `count`, which is > 0.
uint rsColumns(uint count) { return 1u << max(findMSB(count - 1u) + 1, 1); }

// A light id with probability RsPackedLight::selection, exactly.
uint rsSampleLight(uint count, inout RsRandom random) {
    uint column = rsNextBits(random) >> min(31 - findMSB(count - 1u), 31);
    RsAliasEntry entry = rsLoadAlias(column);
    return rsNextBits(random) < entry.threshold ? column : entry.alias;
}

// Density of a light that is drawn with probability `chance`, and of a point that rsSampleLightUv draws on it.
float rsPdfLight(float chance, RsPackedLight light, uint uv, RsIncident incident, float seen) {
    return chance * rsPdfLightUv(light, uv, incident, seen);
}

#endif
