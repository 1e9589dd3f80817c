// Light that leaves a hit: what lights bring to it and to the vertices behind it, scattered back along the path. At every
// vertex lights are drawn (k candidates from restir/lights/source.glsl, resampled; one shadow ray) and a direction is followed;
// the balance heuristic shares out what both find (Veach 1997), as in restir/di/candidates.glsl.
#ifndef RESTIR_GI_SCATTER_GLSL
#define RESTIR_GI_SCATTER_GLSL
#include "restir/di/candidates.glsl"

RsSurface rsBridgeHit(RsHit hit, vec3 origin, vec3 direction);   // what was hit, seen from where the ray came
// The part of the BSDF times cosine that is the same whatever direction it is seen from; times cosine, 1/sr. Need not
// be less than the whole.
vec3 rsBridgeSteadyBsdf(RsSurface s, vec3 light);

// Radiance towards RsSurface::view. `steady` looks the same from everywhere, and may be reused at other pixels; the rest,
// all - steady, may not, and may be negative.
struct RsScattered {
    vec3 steady;
    vec3 all;
};

// From the third vertex on, paths go on with this chance at least.
#define RS_LEAST_SURVIVAL 0.1

// What a light brings that a direction of density `pdf` has found at `uv`, shared with the lights that were drawn.
vec3 rsShareFound(RsSurface s, uint id, RsPackedLight light, uint uv, float pdf, RsStrategies n) {
    RsIncident incident = rsIncident(light, uv, rsRayOrigin(s));
    if (!(incident.solidAngle > 0.0)) return vec3(0.0);
    float p = pdf * incident.solidAngle;   // per unit of the light's domain
    float chance = rsLightChance(n.source, id, light.selection, rsRayOrigin(s), s.normal);
    float drawn = n.lights * rsPdfLight(chance, light, uv, incident, 0.0);
    return incident.irradiance / incident.solidAngle * (p / (p + drawn));
}

// All that a direction finds: the triangle that it hits, else what is at infinity.
vec3 rsEmissionFound(RsSurface s, RsHit hit, vec3 direction, float pdf, RsStrategies n) {
    vec3 sum = vec3(0.0);
    if (hit.t >= 0.0) {
        uint id = rsBridgeLight(hit);
        if (id == RS_NO_LIGHT) return sum;
        RsPackedLight light = rsLoadLight(id);
        if (rsLightKind(light) != RS_LIGHT_TRIANGLE) return sum;
        return rsShareFound(s, id, light, rsPackUv(hit.barycentrics), pdf, n);
    }
    for (uint i = 0u; i < RS_INFINITE_LIGHTS; ++i) {
        uint id = rsInfiniteLight(i), uv = 0u;
        if (id == RS_NO_LIGHT) break;
        RsPackedLight light = rsLoadLight(id);
        if (rsFindAtInfinity(light, direction, uv)) sum += rsShareFound(s, id, light, uv, pdf, n);
    }
    return sum;
}

// Light scattered at `s` and at up to `vertices` - 1 behind it.
RsScattered rsScatter(RsSurface s, RsLightSource source, uint vertices, uint lightCandidates, inout RsRandom random) {
    RsScattered sum = RsScattered(vec3(0.0), vec3(0.0));
    vec3 steady = vec3(1.0), all = vec3(1.0);   // throughputs
    float k = float(lightCandidates);
    RsStrategies n = RsStrategies(source, k, 1.0);
    for (uint i = 0u; i < vertices; ++i) {
        RsChosenLight chosen = rsResampleLights(s, source, lightCandidates, random);
        vec3 direction = rsBridgeSampleBsdf(s, vec3(rsNext2(random), rsNext(random)));
        float survival = rsNext(random);
        if (chosen.sum > 0.0 && rsUnoccluded(s, chosen.direct.incident)) {
            RsIncident incident = chosen.direct.incident;
            float pl = k * chosen.pdf;
            float pb = chosen.found ? rsBridgeBsdfPdf(s, incident.direction) * incident.solidAngle : 0.0;
            float weight = pl / (pl + pb) * chosen.sum / chosen.direct.target;
            vec3 f = weight * chosen.direct.integrand;
            sum.all += all * f;
            sum.steady += steady * (i == 0u ? weight * incident.irradiance * rsBridgeSteadyBsdf(s, incident.direction) : f);
        }
        float pdf = rsBridgeBsdfPdf(s, direction);
        if (!(pdf > 0.0)) break;
        vec3 f = rsBridgeBsdf(s, direction) / pdf;
        all *= f;
        steady *= i == 0u ? rsBridgeSteadyBsdf(s, direction) / pdf : f;
        if (i > 0u) {
            float chance = clamp(max(all.x, max(all.y, all.z)), RS_LEAST_SURVIVAL, 1.0);
            if (survival >= chance) break;
            all /= chance;
            steady /= chance;
        }
        vec3 origin = rsRayOrigin(s);
        RsHit hit = rsClosestHit(origin, direction, RS_FAR);
        vec3 emission = rsEmissionFound(s, hit, direction, pdf, n);
        sum.all += all * emission;
        sum.steady += steady * emission;
        if (hit.t < 0.0 || i + 1u == vertices) break;
        s = rsBridgeHit(hit, origin, direction);
        if (!s.valid) break;
    }
    return sum;
}

#endif
