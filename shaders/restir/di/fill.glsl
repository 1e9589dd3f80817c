// The pixels that a checkerboard leaves out. All four around are lit: the pixel reflects the mean of what those on the same
// surface do, in two lobes, each over its factor, so that textures stay as they are and light blurs by a pixel. That is
// biased. A pixel that has nobody on its surface shades fresh candidates.
#ifndef RESTIR_DI_FILL_GLSL
#define RESTIR_DI_FILL_GLSL
#include "restir/di/candidates.glsl"
#include "restir/di/field.glsl"
#include "restir/di/shade.glsl"
#include "restir/di/similar.glsl"

RsSurface rsLoadSurface(uvec2 pixel);
RsReservoir rsLoadSource(uvec2 pixel);
RsLobes rsLoadLit(uvec2 pixel);            // what a lit pixel reflects
RsLobes rsBridgeLobeFactors(RsSurface s);

// The part of depthThreshold within which two pixels side by side get the same light: reservoirs are weighed, light is not.
#define RS_FILL_PLANE 0.05

// Else its diffuse lobe is black, whatever light it gets.
bool rsHasDiffuse(RsSurface s) { return rsLuminance(rsBridgeLobeFactors(s).diffuse) > 0.0; }

// `distances`: the lobes' too, of the samples that those around hold.
RsShading rsDiFill(RsSurface s, uvec2 pixel, uvec2 extent, uint lightCount, bool distances, RsDiConstants di,
                   inout RsRandom random) {
    const ivec2 steps[4] = ivec2[](ivec2(-1, 0), ivec2(1, 0), ivec2(0, -1), ivec2(0, 1));
    RsLobes lit = RsLobes(vec3(0.0), vec3(0.0));
    RsDiConstants close = di;
    close.depthThreshold *= RS_FILL_PLANE;
    float count = 0.0, diffuseCount = 0.0, weight = 0.0, distance = 0.0;
    for (uint i = 0u; i < 4u; ++i) {
        ivec2 at = ivec2(pixel) + steps[i];
        if (!rsIsInside(at, extent)) continue;
        RsSurface around = rsLoadSurface(uvec2(at));
        if (rsCompareInFrame(s, around, close) != RS_ACCEPTED) continue;
        count += 1.0;
        diffuseCount += rsHasDiffuse(around) ? 1.0 : 0.0;
        RsLobes other = rsLoadLit(uvec2(at));
        lit.diffuse += other.diffuse;
        lit.specular += other.specular;
        if (!distances) continue;
        RsReservoir r = rsLoadSource(uvec2(at));
        if (!rsHasSample(r)) continue;
        RsDirect direct = rsDirect(s, rsLoadLight(r.light), r.uv);
        weight += direct.target * r.ucw;
        distance += direct.target * r.ucw * min(direct.incident.distance, RS_FARTHEST_HIT);
    }
    if (count == 0.0 || (diffuseCount == 0.0 && rsHasDiffuse(s))) {
        bool occluded;
        return rsDiShade(s, rsDiCandidates(s, lightCount, di, random), di.visibility, occluded);
    }
    lit.diffuse = rsHasDiffuse(s) ? lit.diffuse / max(diffuseCount, 1.0) : vec3(0.0);
    lit.specular /= count;
    distance = weight > 0.0 ? distance / weight : RS_FARTHEST_HIT;
    RsLobes factors = rsBridgeLobeFactors(s);
    return RsShading(lit.diffuse * factors.diffuse + lit.specular * factors.specular,
                     vec4(lit.diffuse, rsLuminance(lit.diffuse) * distance),
                     vec4(lit.specular, rsLuminance(lit.specular) * distance));
}

#endif
