// Neighbours on a spiral around a pixel, turned and scaled by its random numbers.
#ifndef RESTIR_DI_SPIRAL_GLSL
#define RESTIR_DI_SPIRAL_GLSL
#include "restir/di/combine.glsl"
#include "restir/di/field.glsl"

#define RS_GOLDEN_TURN 0.61803399

ivec2 rsNeighbourPixel(RsNeighbourhood where, uint i) {
    // precise: found and loaded pixels are the same
    precise float r = where.radius * sqrt((float(i) + where.rotation.x) / float(where.count));
    precise float phi = 2.0 * RS_PI * (where.rotation.y + float(i) * RS_GOLDEN_TURN);
    ivec2 at = ivec2(floor(vec2(where.pixel) + 0.5 + r * vec2(cos(phi), sin(phi))));
    return rsOnField(at, where.field);
}

#endif
