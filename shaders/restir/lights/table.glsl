// Drawing a light by power in O(1) (alias method: Walker 1977, Vose 1991).
// The includer provides the table and the lights:
#ifndef RESTIR_LIGHTS_TABLE_GLSL
#define RESTIR_LIGHTS_TABLE_GLSL
#include "restir/core/random.glsl"
#include "restir/lights/light.glsl"

RsAliasEntry rsLoadAlias(uint column);
RsPackedLight rsLoadLight(uint id);           // RS_LIGHT_NONE for ids that name nothing this frame
RsPackedLight rsLoadPreviousLight(uint id);   // as in the last frame

// A light id with probability RsPackedLight::selection. `count` > 0.
uint rsSampleLight(uint count, inout RsRandom random) {
    uint column = rsNextIndex(random, count);
    RsAliasEntry entry = rsLoadAlias(column);
    return rsNextBits(random) < entry.threshold ? column : entry.alias;
}

#endif
