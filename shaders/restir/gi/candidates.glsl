// A fresh path: a direction from the BSDF, and the light that comes back from what it hits. Emission of that is direct
// light and left to ReSTIR DI, as is what a miss would see.
#ifndef RESTIR_GI_CANDIDATES_GLSL
#define RESTIR_GI_CANDIDATES_GLSL
#include "restir/gi/reservoir.glsl"
#include "restir/gi/scatter.glsl"

struct RsGiFresh {
    RsGiReservoir reservoir;
    RsShading all;     // what it brings to the pixel; w of its lobes: the distance of its second vertex
    RsShading rest;    // the part of that which no reservoir can hold
};

vec3 rsFiniteLight(vec3 light) {
    return abs(light.x) + abs(light.y) + abs(light.z) < 3e38 ? light : vec3(0.0);   // NaN from hostile input counts as unlit
}

// Light from `direction`, drawn with density `pdf`.
RsShading rsShadeFresh(RsSurface s, vec3 direction, float pdf, float distance, vec3 light) {
    RsShading shading = rsNoLight();
    shading.radiance = rsFiniteLight(rsBridgeBsdf(s, direction) / pdf * light);
    if (!rsWantsLobes()) return shading;
    RsLobes lobes = rsBridgeLobes(s, direction);
    shading.diffuse = vec4(rsFiniteLight(lobes.diffuse / pdf * light), distance);
    shading.specular = vec4(rsFiniteLight(lobes.specular / pdf * light), distance);
    return shading;
}

// `bounces`: scattering events, that at `s` among them; at least 2.
RsGiFresh rsGiCandidate(RsSurface s, RsLightSource source, uint bounces, uint lightCandidates, inout RsRandom random) {
    RsGiFresh none = RsGiFresh(rsEmptyGiReservoir(1u), rsNoLight(), rsNoLight());
    vec3 direction = rsBridgeSampleBsdf(s, vec3(rsNext2(random), rsNext(random)));
    float pdf = rsBridgeBsdfPdf(s, direction);
    if (!(pdf > 0.0)) return none;
    vec3 origin = rsRayOrigin(s);
    RsHit hit = rsClosestHit(origin, direction, RS_FAR);
    if (hit.t < 0.0) return none;
    RsSurface there = rsBridgeHit(hit, origin, direction);
    if (!there.valid) return none;
    RsScattered light = rsScatter(there, source, bounces - 1u, lightCandidates, random);

    RsGiFresh fresh = RsGiFresh(rsEmptyGiReservoir(1u), rsShadeFresh(s, direction, pdf, hit.t, light.all),
                                rsShadeFresh(s, direction, pdf, hit.t, light.all - light.steady));
    RsGiReservoir r = RsGiReservoir(there.position, rsPackNormal(there.geometricNormal), rsPackFineRadiance(light.steady), 0.0, 0u);
    RsIncident incident = rsIncidentFrom(r, origin);   // from what is stored
    float p = rsBridgeBsdfPdf(s, incident.direction) * incident.solidAngle;
    if (p > 0.0 && rsLuminance(incident.irradiance) > 0.0) fresh.reservoir = rsKeep(r, 1.0 / p, 1u);
    return fresh;
}

#endif
