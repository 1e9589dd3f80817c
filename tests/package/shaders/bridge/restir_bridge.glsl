// A host whose surfaces are all diffuse.
#define RS_BRIDGE_BSDF
#include "restir/core/surface.glsl"

const float kPi = 3.14159265;

float rsBridgeBsdfPdf(RsSurface s, vec3 light) { return max(dot(s.normal, light), 0.0) / kPi; }
vec3 rsBridgeBsdf(RsSurface s, vec3 light) { return s.baseColor * rsBridgeBsdfPdf(s, light); }
vec3 rsBridgeSampleBsdf(RsSurface s, vec3 u) {
    float angle = 2.0 * kPi * u.x;
    return rsBasis(s.normal) * vec3(sqrt(u.y) * vec2(cos(angle), sin(angle)), sqrt(1.0 - u.y));
}

#include "restir/bridge/standard.glsl"
