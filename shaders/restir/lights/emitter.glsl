// Triangles of the scene as lights.
#ifndef RESTIR_LIGHTS_EMITTER_GLSL
#define RESTIR_LIGHTS_EMITTER_GLSL
#include "restir/lights/power.glsl"

// What a bridge says of a triangle.
struct RsEmitter {
    vec3 corners[3];   // world space, in index order: counter-clockwise seen from the emitting side
    vec2 uvs[3];
    vec3 emission;     // radiance, times the texture
    uint texture;      // for rsBridgeTexture; RS_NO_TEXTURE
    bool twoSided;
};
RsEmitter rsNoEmitter() {
    return RsEmitter(vec3[3](vec3(0.0), vec3(0.0), vec3(0.0)), vec2[3](vec2(0.0), vec2(0.0), vec2(0.0)), vec3(0.0),
                     0xffffffffu, false);
}

RsPackedLight rsNoLight() {
    return RsPackedLight(vec3(0.0), RS_LIGHT_NONE, vec3(0.0), vec3(0.0), vec3(0.0), 0.0, vec2(0.0), vec2(0.0), vec2(0.0));
}

// Nothing checks what is on the device: NaN and what is negative become 0.
vec3 rsRadianceOf(vec3 v) { return mix(vec3(0.0), min(v, vec3(RS_LIGHT_LARGEST)), greaterThan(v, vec3(0.0))); }

// `mean` is that of the texture over the triangle. A triangle that is black or has no area is no light; nor is one that
// LightTable::upload would refuse.
RsPackedLight rsEmitterLight(RsEmitter emitter, vec3 mean) {
    vec3 edge1 = emitter.corners[1] - emitter.corners[0], edge2 = emitter.corners[2] - emitter.corners[0];
    vec3 emission = rsRadianceOf(emitter.emission);
    float shine = rsLuminance(emission * mean);
    const float longest = RS_LIGHT_LONGEST * RS_LIGHT_LONGEST;
    bool fits = dot(edge1, edge1) <= longest && dot(edge2, edge2) <= longest;
    if (!fits || !(shine > 0.0) || !(rsTriangleArea(edge1, edge2).mantissa > 0.0)) return rsNoLight();
    bool textured = emitter.texture < RS_LIGHT_NO_TEXTURE;
    RsPackedLight light;
    light.position = emitter.corners[0];
    light.kindAndTexture = RS_LIGHT_TRIANGLE | (emitter.twoSided ? RS_LIGHT_TWO_SIDED : 0u) |
                           min(emitter.texture, RS_LIGHT_NO_TEXTURE) << RS_LIGHT_TEXTURE_SHIFT;
    light.edge1 = edge1;
    light.edge2 = edge2;
    light.emission = emission;
    light.selection = shine;
    light.uv0 = textured ? emitter.uvs[0] : vec2(0.0);
    light.uv1 = textured ? emitter.uvs[1] : vec2(0.0);
    light.uv2 = textured ? emitter.uvs[2] : vec2(0.0);
    return light;
}

#endif
