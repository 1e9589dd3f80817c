// Lights as the passes read them. Hosts fill restir::Light (lights.h); LightTable packs it.
#ifndef RESTIR_SHARED_LIGHTS_H
#define RESTIR_SHARED_LIGHTS_H
#include "restir/shared/types.h"
RS_SHARED_BEGIN

// 80 bytes, stored as a stream of five uvec4 (RS_LIGHT_STRIDE). The slot of a light is its id, so that a
// reservoir finds its light again in any frame without a remap table.
struct RsPackedLight {
    vec3 position;        // triangle: vertex 0
    uint kindAndTexture;  // bits 0..2 kind, bit 3 two-sided, bits 4..31 emission texture (RS_LIGHT_NO_TEXTURE)
    vec3 edge1;           // triangle: vertex 1 - vertex 0; spot, directional: unit direction the light travels in
    vec3 edge2;           // triangle: vertex 2 - vertex 0; spot: x = angle scale, y = angle offset; point, spot: z = range
    vec3 emission;        // triangle: radiance; point, spot: radiant intensity; directional: irradiance
    float selection;      // probability with which the alias table draws this light, exactly
    vec2 uv0;             // texture coordinates of the three vertices
    vec2 uv1;
    vec2 uv2;
};

// One column of the alias table: 32 random bits below `threshold` keep the column's own light.
struct RsAliasEntry {
    uint threshold;
    uint alias;
};

RS_SHARED_END

#define RS_LIGHT_STRIDE 5u
#define RS_LIGHT_NONE 0u
#define RS_LIGHT_TRIANGLE 1u
#define RS_LIGHT_POINT 2u
#define RS_LIGHT_SPOT 3u
#define RS_LIGHT_DIRECTIONAL 4u
#define RS_LIGHT_KIND_MASK 7u
#define RS_LIGHT_TWO_SIDED 8u
#define RS_LIGHT_TEXTURE_SHIFT 4u
#define RS_LIGHT_NO_TEXTURE 0x0fffffffu

#endif
