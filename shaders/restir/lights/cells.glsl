// Points of the unit square as reservoirs keep them: one of 65536 x 65536 cells, standing for its centre.
#ifndef RESTIR_LIGHTS_CELLS_GLSL
#define RESTIR_LIGHTS_CELLS_GLSL
#include "restir/core/math.glsl"

#define RS_CELLS 65536.0

vec2 rsCellCentre(uint cell) { return (vec2(cell & 0xffffu, cell >> 16u) + 0.5) / RS_CELLS; }
uint rsCellOf(vec2 uv) {
    uvec2 at = uvec2(clamp(uv * RS_CELLS, 0.0, RS_CELLS - 1.0));
    return at.x | at.y << 16u;
}

// The unit square on the unit disc, areas to equal shares, squares around the centre to circles (Shirley and Chiu 1997).
vec2 rsDiscFromSquare(vec2 uv) {
    vec2 p = 2.0 * uv - 1.0;
    if (p == vec2(0.0)) return p;
    bool wide = abs(p.x) > abs(p.y);
    float r = wide ? p.x : p.y;
    float angle = 0.25 * RS_PI * (wide ? p.y / p.x : p.x / p.y);
    vec2 at = vec2(cos(angle), sin(angle));
    return r * (wide ? at : at.yx);
}
vec2 rsSquareFromDisc(vec2 p) {
    bool wide = abs(p.x) > abs(p.y);
    float r = length(p) * (wide ? sign(p.x) : sign(p.y));
    float angle = wide ? rsAtan2(p.y * sign(p.x), abs(p.x)) : rsAtan2(p.x * sign(p.y), abs(p.y));
    float across = r * angle / (0.25 * RS_PI);
    return 0.5 + 0.5 * (wide ? vec2(r, across) : vec2(across, r));
}

#endif
