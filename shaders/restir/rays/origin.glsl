#ifndef RESTIR_RAYS_ORIGIN_GLSL
#define RESTIR_RAYS_ORIGIN_GLSL
#include "restir/core/surface.glsl"

// Where rays of a surface start: off the geometry by the error of a position rebuilt from 32-bit depth, which grows
// with the magnitude of the coordinates and with the distance to the eye.
#define RS_ORIGIN_OFFSET 4e-5

vec3 rsRayOrigin(RsSurface s) {
    vec3 p = abs(s.position);
    return s.position + s.geometricNormal * (RS_ORIGIN_OFFSET * max(s.depth, max(p.x, max(p.y, p.z))));
}

#endif
