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
RsLobes rsBridgeLobes(RsSurface s, vec3 light);
bool rsWantsLobes();   // hook of the passes: whether RsShading's lobes are asked for

// A shadow ray stops this fraction short of the light, or the light's own triangle would block it.
#define RS_SHADOW_LENGTH 0.9999

struct RsDirect {
    vec3 integrand;
    float target;
    RsIncident incident;
};

RsDirect rsReflect(RsSurface s, RsIncident incident) {
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

RsDirect rsDirect(RsSurface s, RsPackedLight light, uint uv) {
    return rsReflect(s, rsIncident(light, uv, rsRayOrigin(s)));   // so that target, densities and rays agree
}

// Light that a pixel reflects, summed up.
struct RsShading {
    vec3 radiance;
    // With rsWantsLobes() the same in rsBridgeLobes' two; w the sum of luminance x distance.
    vec4 diffuse;
    vec4 specular;
};

vec4 rsLobe(vec3 light, float distance) { return vec4(light, rsLuminance(light) * distance); }
RsShading rsNoLight() { return RsShading(vec3(0.0), vec4(0.0), vec4(0.0)); }

// Lights at infinity count as so far away, metres: the largest half float.
#define RS_FARTHEST_HIT 65504.0

void rsAddLight(inout RsShading sum, RsSurface s, RsDirect direct, float weight) {
    sum.radiance += weight * direct.integrand;
    if (!rsWantsLobes() || !(weight * direct.target > 0.0)) return;
    RsLobes lobes = rsBridgeLobes(s, direct.incident.direction);
    vec3 irradiance = weight * direct.incident.irradiance;
    vec3 diffuse = irradiance * lobes.diffuse, specular = irradiance * lobes.specular;
    float distance = min(direct.incident.distance, RS_FARTHEST_HIT);
    sum.diffuse += rsLobe(diffuse, distance);
    sum.specular += rsLobe(specular, distance);
}

// Of what a lobe reflects.
float rsMeanDistance(vec4 lobe) {
    float luminance = rsLuminance(lobe.rgb);
    return luminance > 0.0 ? min(lobe.w / luminance, RS_FARTHEST_HIT) : 0.0;
}

RsShading rsScale(RsShading sum, float by) {
    return RsShading(sum.radiance * by, sum.diffuse * by, sum.specular * by);
}

// `previous`: a surface and a light of last frame, in last frame's scene.
bool rsUnoccluded(RsSurface s, RsIncident incident, bool previous) {
    float reach = incident.distance >= RS_FAR ? RS_FAR : incident.distance * RS_SHADOW_LENGTH;
    return !rsOccluded(rsRayOrigin(s), incident.direction, reach, previous);
}
bool rsUnoccluded(RsSurface s, RsIncident incident) { return rsUnoccluded(s, incident, false); }

#endif
