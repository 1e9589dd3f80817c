// Lights as the passes read them. Hosts fill restir::Light (lights.h); LightTable packs it.
#ifndef RESTIR_SHARED_LIGHTS_H
#define RESTIR_SHARED_LIGHTS_H
#include "restir/shared/types.h"
RS_SHARED_BEGIN

// 80 bytes, stored as a stream of five uvec4 (RS_LIGHT_STRIDE). The slot of a light is its id, so that a
// reservoir finds its light again in any frame without a remap table.
//                position         edge1                      edge2
//   triangle     vertex 0         vertex 1 - vertex 0        vertex 2 - vertex 0
//   rectangle    corner           next corner - corner       last corner - corner
//   disk         centre           radius along x             radius along y; emits along x cross y
//   capsule      start of axis    end - start; 0: a sphere   x = radius
//   point        position                                    z = range
//   spot         position         unit direction of travel   x = angle scale, y = angle offset, z = range
//   directional                   unit direction of travel   x = 1 - cos(angular radius)
//   environment  the map's x, y and z axes in the world
// A texture of a point or spot light is its profile: edge1 is its axis, away from the lamp, uv0 and uv1.x
// where it is turned to.
struct RsPackedLight {
    vec3 position;
    uint kindAndTexture;   // bits 0..3 kind, bit 4 two-sided, bits 5..31 emission texture
                           // (RS_LIGHT_NO_TEXTURE)
    vec3 edge1;
    vec3 edge2;
    vec3 emission;   // radiance; point, spot: radiant intensity; directional: irradiance; environment: factor
    float selection;   // probability with which the alias table draws this light, exactly
    vec2 uv0;          // texture coordinates of the three vertices, or corners
    vec2 uv1;
    vec2 uv2;
};

// One column of the alias table: 32 random bits below `threshold` keep the column's own light.
struct RsAliasEntry {
    uint threshold;
    uint alias;
};

// One texel of the environment map: its column of an alias table over all texels, and its probability to be
// drawn.
struct RsEnvironmentTexel {
    uint threshold;
    uint alias;
    float probability;
};

RS_SHARED_END

#define RS_LIGHT_STRIDE 5u
#define RS_LIGHT_NONE 0u
#define RS_LIGHT_TRIANGLE 1u
#define RS_LIGHT_POINT 2u
#define RS_LIGHT_SPOT 3u
#define RS_LIGHT_DIRECTIONAL 4u
#define RS_LIGHT_RECTANGLE 5u
#define RS_LIGHT_DISK 6u
#define RS_LIGHT_CAPSULE 7u
#define RS_LIGHT_ENVIRONMENT 8u
#define RS_LIGHT_KIND_MASK 15u
#define RS_LIGHT_TWO_SIDED 16u
#define RS_LIGHT_TEXTURE_SHIFT 5u
#define RS_LIGHT_NO_TEXTURE 0x07ffffffu

#define RS_LIGHT_LARGEST 1e30   // of an emission: products with distances, areas and counts stay finite
#define RS_LIGHT_LONGEST 1e9    // of an edge or a radius, metres, likewise

// Lights at infinity with an extent, which rays that miss everything find: an environment and suns.
#define RS_INFINITE_LIGHTS 4u

#endif
