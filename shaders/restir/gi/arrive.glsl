// Light that arrives at a hit: what lights bring to it and to the vertices behind it, scattered back along the path. At every
// vertex lights are drawn (k candidates from restir/lights/source.glsl, resampled; one shadow ray) and a direction is followed;
// the balance heuristic shares out what both find (Veach 1997), as in restir/di/candidates.glsl.
#ifndef RESTIR_GI_ARRIVE_GLSL
#define RESTIR_GI_ARRIVE_GLSL
#include "restir/di/candidates.glsl"

RsSurface rsBridgeHit(RsHit hit, vec3 origin, vec3 direction);   // what was hit, seen from where the ray came

// A point on a light: `weight` times what of its light the hit scatters is what leaves the hit; 0: none.
struct RsLightArrival {
    uint light;
    uint uv;
    float weight;
};
// From one direction, packed and then used as packed: radiance over the density of all that it took to find it. Times BSDF and
// cosine it is what leaves the hit.
struct RsFollowed {
    uint direction;
    vec3 radiance;
};

// All that arrives is the sum of these.
struct RsArriving {
    RsLightArrival drawn;   // what a shadow ray reached
    RsLightArrival found;   // the triangle that the path hit next
    RsFollowed followed;    // all else that it found
};

// From the third vertex on, paths go on with this chance at least.
#define RS_LEAST_SURVIVAL 0.1

// What a direction of density `pdf` has found counts for, shared with the lights that were drawn: p / (p + drawn) over p.
float rsFoundWeight(RsSurface s, uint id, RsPackedLight light, uint uv, RsIncident incident, float pdf, RsStrategies n) {
    float chance = rsLightChance(n.source, id, light.selection, rsRayOrigin(s), s.normal);
    return 1.0 / (pdf * incident.solidAngle + n.lights * rsPdfLight(chance, light, uv, incident, 0.0));
}

// A triangle that it has hit.
RsLightArrival rsFoundTriangle(RsSurface s, RsHit hit, float pdf, RsStrategies n, out vec3 irradiance) {
    irradiance = vec3(0.0);
    RsLightArrival found = RsLightArrival(RS_NO_LIGHT, 0u, 0.0);
    uint id = hit.t >= 0.0 ? rsBridgeLight(hit) : RS_NO_LIGHT;
    if (id == RS_NO_LIGHT) return found;
    RsPackedLight light = rsLoadLight(id);
    if (rsLightKind(light) != RS_LIGHT_TRIANGLE) return found;
    uint uv = rsPackUv(hit.barycentrics);
    RsIncident incident = rsIncident(light, uv, rsRayOrigin(s));
    if (!(incident.solidAngle > 0.0)) return found;
    irradiance = incident.irradiance;
    return RsLightArrival(id, uv, rsFoundWeight(s, id, light, uv, incident, pdf, n));
}

// What it finds at infinity; radiance over its density.
vec3 rsFoundAtInfinity(RsSurface s, vec3 direction, float pdf, RsStrategies n) {
    vec3 sum = vec3(0.0);
    for (uint i = 0u; i < RS_INFINITE_LIGHTS; ++i) {
        uint id = rsInfiniteLight(i), uv = 0u;
        if (id == RS_NO_LIGHT) break;
        RsPackedLight light = rsLoadLight(id);
        if (!rsFindAtInfinity(light, direction, uv)) continue;
        RsIncident incident = rsIncident(light, uv, rsRayOrigin(s));
        if (incident.solidAngle > 0.0) sum += incident.irradiance * rsFoundWeight(s, id, light, uv, incident, pdf, n);
    }
    return sum;
}

// Light that arrives at `s`, scattered at up to `vertices` - 1 vertices behind it.
RsArriving rsArriving(RsSurface s, RsLightSource source, uint vertices, uint lightCandidates, inout RsRandom random) {
    RsLightArrival none = RsLightArrival(RS_NO_LIGHT, 0u, 0.0);
    RsArriving sum = RsArriving(none, none, RsFollowed(0u, vec3(0.0)));
    vec3 throughput = vec3(1.0), whole = vec3(1.0);   // without and with what the first vertex reflects
    float k = float(lightCandidates);
    for (uint i = 0u; i < vertices; ++i) {
        bool first = i == 0u;
        RsStrategies n = RsStrategies(rsSourceAt(source, rsRayOrigin(s)), k, 1.0);
        RsChosenLight chosen = rsResampleLights(s, n.source, lightCandidates, random);
        vec3 direction = rsBridgeSampleBsdf(s, vec3(rsNext2(random), rsNext(random)));
        float survival = rsNext(random);
        if (chosen.sum > 0.0 && rsUnoccluded(s, chosen.direct.incident)) {
            RsIncident incident = chosen.direct.incident;
            float pl = k * chosen.pdf;
            float pb = chosen.found ? rsBridgeBsdfPdf(s, incident.direction) * incident.solidAngle : 0.0;
            float weight = pl / (pl + pb) * chosen.sum / chosen.direct.target;
            if (first) sum.drawn = RsLightArrival(chosen.light, chosen.uv, weight);
            else sum.followed.radiance += throughput * weight * chosen.direct.integrand;
        }
        if (first) {
            sum.followed.direction = rsPackNormal(direction);
            direction = rsUnpackNormal(sum.followed.direction);
        }
        float pdf = rsBridgeBsdfPdf(s, direction);
        if (!(pdf > 0.0)) break;
        vec3 f = rsBridgeBsdf(s, direction);
        vec3 origin = rsRayOrigin(s);
        whole *= f / pdf;
        if (!first) {
            float chance = clamp(max(whole.x, max(whole.y, whole.z)), RS_LEAST_SURVIVAL, 1.0);
            if (survival >= chance) break;
            throughput *= f / chance;
            whole /= chance;
        }
        RsHit hit = rsClosestHit(origin, direction, RS_FAR);
        vec3 irradiance;
        RsLightArrival found = rsFoundTriangle(s, hit, pdf, n, irradiance);
        if (first) sum.found = found;
        else sum.followed.radiance += throughput * found.weight * irradiance;
        if (hit.t < 0.0) sum.followed.radiance += throughput * rsFoundAtInfinity(s, direction, pdf, n);
        if (hit.t < 0.0 || i + 1u == vertices) break;
        throughput /= pdf;
        s = rsBridgeHit(hit, origin, direction);
        if (!s.valid) break;
    }
    return sum;
}

#endif
