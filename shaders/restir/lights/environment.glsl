// The environment map: equirectangular, u = 1/2 + atan(z, x) / 2 pi and v = acos(y) / pi (0 on top) of a direction in the
// map's axes. Points are drawn texel by texel from an alias table, uniform over the cells of a texel, so that the density
// of every cell is exact, and a look-up.
#ifndef RESTIR_LIGHTS_ENVIRONMENT_GLSL
#define RESTIR_LIGHTS_ENVIRONMENT_GLSL
#include "restir/core/random.glsl"
#include "restir/lights/cells.glsl"
#include "restir/shared/lights.h"

// Provided by the includer: the table, row by row.
uvec2 rsEnvironmentExtent();   // texels; at most 65536 each
RsEnvironmentTexel rsLoadEnvironment(uint index);

vec3 rsEnvironmentDirection(RsPackedLight light, vec2 uv) {
    float phi = 2.0 * RS_PI * (uv.x - 0.5), theta = RS_PI * uv.y, s = sin(theta);
    return normalize(s * cos(phi) * light.position + cos(theta) * light.edge1 + s * sin(phi) * light.edge2);
}
uint rsEnvironmentUv(RsPackedLight light, vec3 direction) {
    vec3 d = vec3(dot(direction, light.position), dot(direction, light.edge1), dot(direction, light.edge2));
    float u = 0.5 + rsAtan2(d.z, d.x) / (2.0 * RS_PI);
    return rsCellOf(vec2(fract(u), rsAtan2(length(d.xz), d.y) / RS_PI));
}
// d omega per unit of (u, v).
float rsEnvironmentSolidAngle(vec2 uv) { return 2.0 * RS_PI * RS_PI * sin(RS_PI * uv.y); }

// First cell of each column or row of texels: those that begin in it. extent < 65536 leaves none empty.
uvec2 rsFirstCell(uvec2 texel, uvec2 extent) { return ((texel << 16u) + extent - 1u) / extent; }

uint rsSampleEnvironmentUv(inout RsRandom random) {
    uvec2 extent = rsEnvironmentExtent();
    uint index = rsNextIndex(random, extent.x * extent.y);
    RsEnvironmentTexel texel = rsLoadEnvironment(index);
    if (rsNextBits(random) >= texel.threshold) index = texel.alias;
    uvec2 at = uvec2(index % extent.x, index / extent.x);
    uvec2 first = rsFirstCell(at, extent), count = rsFirstCell(at + 1u, extent) - first;
    uvec2 cell = first + uvec2(rsNextIndex(random, count.x), rsNextIndex(random, count.y));
    return cell.x | cell.y << 16u;
}
float rsPdfEnvironmentUv(uint cell) {
    uvec2 extent = rsEnvironmentExtent();
    uvec2 at = (uvec2(cell & 0xffffu, cell >> 16u) * extent) >> 16u;
    uvec2 count = rsFirstCell(at + 1u, extent) - rsFirstCell(at, extent);
    float share = float(count.x) * float(count.y) / (RS_CELLS * RS_CELLS);
    return rsLoadEnvironment(at.y * extent.x + at.x).probability / share;
}

#endif
