// The pixels that a checkerboard leaves out. One that has nobody around on its surface shades fresh candidates.
#ifndef RESTIR_DI_FILL_GLSL
#define RESTIR_DI_FILL_GLSL
#include "restir/di/around.glsl"
#include "restir/di/candidates.glsl"
#include "restir/di/shade.glsl"

RsReservoir rsLoadSource(uvec2 pixel);

// Of the sample that a lit pixel holds, seen from `s`.
vec2 rsLitDistance(RsSurface s, uvec2 pixel) {
    RsReservoir r = rsLoadSource(pixel);
    if (!rsHasSample(r)) return vec2(0.0);
    RsDirect direct = rsDirect(s, rsLoadLight(r.light), r.uv);
    float weight = direct.target * r.ucw;
    return weight * vec2(min(direct.incident.distance, RS_FARTHEST_HIT), 1.0);
}

// `distances`: of the lobes, too.
RsShading rsDiFill(RsSurface s, uvec2 pixel, uvec2 extent, uint lightCount, bool distances, RsDiConstants di,
                   inout RsRandom random) {
    RsShading shading;
    if (rsFromAround(s, pixel, extent, distances, di, shading)) return shading;
    bool occluded;
    return rsDiShade(s, rsDiCandidates(s, lightCount, di, random), di.visibility, occluded);
}

#endif
