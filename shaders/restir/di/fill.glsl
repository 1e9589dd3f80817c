// The pixels that a checkerboard leaves out. All four around are lit: the pixel shades, with its own surface, the mean of
// what those on the same surface hold,
//     1/n sum f(Y_i) V W_i
// With samples that were killed where occluded, V is the neighbours': shadows blur by a pixel, and that is biased. Else one
// of the samples is drawn and gets a ray. A pixel that has nobody on its surface shades fresh candidates.
#ifndef RESTIR_DI_FILL_GLSL
#define RESTIR_DI_FILL_GLSL
#include "restir/di/candidates.glsl"
#include "restir/di/combine.glsl"
#include "restir/di/shade.glsl"
#include "restir/di/similar.glsl"
#include "restir/di/spiral.glsl"

RsSurface rsLoadSurface(uvec2 pixel);
RsReservoir rsLoadSource(uvec2 pixel);

RsShading rsDiFill(RsSurface s, uvec2 pixel, uvec2 extent, uint lightCount, RsDiConstants di, inout RsRandom random) {
    const ivec2 around[4] = ivec2[](ivec2(-1, 0), ivec2(1, 0), ivec2(0, -1), ivec2(0, 1));
    bool draws = di.visibility == RS_VISIBILITY_NONE, occluded;
    RsSelection drawn = RsSelection(RS_NO_LIGHT, 0u, 0u, 0.0, 0.0, 0.0, -1);
    RsShading sum = rsNoLight();
    float count = 0.0;
    for (uint i = 0u; i < 4u; ++i) {
        ivec2 at = ivec2(pixel) + around[i];
        if (!rsIsInside(at, extent) || rsCompareInFrame(s, rsLoadSurface(uvec2(at)), di) != RS_ACCEPTED) continue;
        count += 1.0;
        RsReservoir r = rsLoadSource(uvec2(at));
        if (!rsHasSample(r)) continue;
        RsDirect direct = rsDirect(s, rsLoadLight(r.light), r.uv);
        if (draws) rsSelect(drawn, r, direct.target * r.ucw, direct.target, direct.target, int(i), rsNext(random));
        else rsAddLight(sum, s, direct, r.ucw);
    }
    if (count == 0.0) return rsDiShade(s, rsDiCandidates(s, lightCount, di, random), di.visibility, occluded);
    if (!draws) return rsDivide(sum, count);
    if (!(drawn.sum > 0.0)) return sum;
    RsReservoir r = rsMakeReservoir(drawn.light, drawn.uv, drawn.sum / (count * drawn.target), 1u, 0u);
    return rsDiShade(s, r, di.visibility, occluded);
}

#endif
