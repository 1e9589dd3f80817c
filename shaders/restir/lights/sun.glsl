// Directional lights of some angular radius: a disc of the sky, uniform in solid angle. `cone` is 1 - cos(angular radius).
#ifndef RESTIR_LIGHTS_SUN_GLSL
#define RESTIR_LIGHTS_SUN_GLSL
#include "restir/lights/cells.glsl"
#include "restir/shared/lights.h"

float rsSunCone(RsPackedLight light) { return light.edge2.x; }
float rsSunSolidAngle(float cone) { return 2.0 * RS_PI * cone; }
// Radiance x solid angle over the irradiance of the whole sun on a plane that faces it, which is pi sin^2 x radiance.
float rsSunFlux(float cone) { return 2.0 / (2.0 - cone); }

// Towards the sun.
vec3 rsSunDirection(RsPackedLight light, vec2 uv) {
    vec2 p = rsDiscFromSquare(uv);
    float lessCosine = dot(p, p) * rsSunCone(light);
    vec2 across = p * sqrt(rsSunCone(light) * (2.0 - lessCosine));
    return normalize(rsBasis(-light.edge1) * vec3(across, 1.0 - lessCosine));
}

// The point of the sun in that direction; false: none.
bool rsSunUv(RsPackedLight light, vec3 direction, out uint uv) {
    vec3 offset = direction + light.edge1;
    float lessCosine = 0.5 * dot(offset, offset), cone = rsSunCone(light);
    uv = 0u;
    if (!(lessCosine < cone)) return false;
    vec2 across = (direction * rsBasis(-light.edge1)).xy;
    uv = rsCellOf(rsSquareFromDisc(across * inversesqrt(cone * (2.0 - lessCosine))));
    return true;
}

#endif
