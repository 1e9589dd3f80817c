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
    RsIncident incident = rsIncident(light, uv, s.position);
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

// The ray starts off the surface and ends at the point on the light, so that it grazes neither.
bool rsUnoccluded(RsSurface s, RsIncident incident) {
    vec3 origin = rsRayOrigin(s);
    if (incident.distance >= RS_FAR) return !rsOccluded(origin, incident.direction, RS_FAR);
    vec3 segment = s.position + incident.direction * incident.distance - origin;
    return !rsOccluded(origin, segment, RS_SHADOW_LENGTH);
}

#endif
