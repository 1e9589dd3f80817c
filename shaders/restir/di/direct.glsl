// The integrand of direct lighting, f = BSDF x cosine x incident light, without visibility, and the target function
// p^ = luminance(f), in the measure of restir/lights/light.glsl.
#ifndef RESTIR_DI_DIRECT_GLSL
#define RESTIR_DI_DIRECT_GLSL
#include "restir/lights/table.glsl"
#include "restir/rays/hit.glsl"
#include "restir/rays/origin.glsl"

vec3 rsBridgeBsdf(RsSurface s, vec3 light);
float rsBridgeBsdfPdf(RsSurface s, vec3 light);
vec3 rsBridgeSampleBsdf(RsSurface s, vec3 u);

// A shadow ray stops this fraction short of the light, or the light's own triangle would block it.
#define RS_SHADOW_LENGTH 0.9999

struct RsDirect {
    vec3 integrand;
    float target;
    RsIncident incident;
};

RsDirect rsDirect(RsSurface s, RsPackedLight light, uint uv) {
    RsIncident incident = rsIncident(light, uv, rsRayOrigin(s));   // so that target, densities and rays agree
    vec3 f = incident.irradiance.x + incident.irradiance.y + incident.irradiance.z > 0.0
                 ? incident.irradiance * rsBridgeBsdf(s, incident.direction)
                 : vec3(0.0);
    float target = rsLuminance(f);
    if (!(target > 0.0 && target < 3e38)) {   // NaN and infinity from hostile input count as unlit
        f = vec3(0.0);
        target = 0.0;
    }
    return RsDirect(f, target, incident);
}

// `previous`: a surface and a light of last frame, in last frame's scene.
bool rsUnoccluded(RsSurface s, RsIncident incident, bool previous) {
    float reach = incident.distance >= RS_FAR ? RS_FAR : incident.distance * RS_SHADOW_LENGTH;
    return !rsOccluded(rsRayOrigin(s), incident.direction, reach, previous);
}
bool rsUnoccluded(RsSurface s, RsIncident incident) { return rsUnoccluded(s, incident, false); }

#endif
