// A pixel that the frame leaves out. Of those around the two or four closest are lit: it reflects the mean of what those on the same
// surface do, in two lobes, each over its factor, so that textures stay as they are and light blurs by a pixel. That is biased.
#ifndef RESTIR_DI_AROUND_GLSL
#define RESTIR_DI_AROUND_GLSL
#include "restir/di/direct.glsl"
#include "restir/di/field.glsl"
#include "restir/di/similar.glsl"

RsSurface rsLoadSurface(uvec2 pixel);
RsLobes rsLoadLit(uvec2 pixel);                      // what a lit pixel reflects
vec2 rsLitDistance(RsSurface s, uvec2 pixel);        // how far that comes from, times a weight, and the weight
RsLobes rsBridgeLobeFactors(RsSurface s);

// The part of depthThreshold within which two pixels side by side get the same light: reservoirs are weighed, light is not.
#define RS_FILL_PLANE 0.05

// Else its diffuse lobe is black, whatever light it gets.
bool rsHasDiffuse(RsSurface s) { return rsLuminance(rsBridgeLobeFactors(s).diffuse) > 0.0; }

// False: nobody around is on the surface. `distances`: of the lobes are asked for.
bool rsFromAround(RsSurface s, uvec2 pixel, uvec2 extent, bool distances, RsDiConstants reuse, out RsShading shading) {
    RsLobes lit = RsLobes(vec3(0.0), vec3(0.0));
    RsDiConstants close = reuse;
    close.depthThreshold *= RS_FILL_PLANE;
    float count = 0.0, diffuseCount = 0.0;
    vec2 far = vec2(0.0);
    for (int i = 0; i < 9; ++i) {
        ivec2 at = ivec2(pixel) + ivec2(i % 3, i / 3) - 1;
        if (!rsIsOnField(at, reuse.field) || !rsIsInside(at, extent)) continue;
        RsSurface around = rsLoadSurface(uvec2(at));
        if (rsCompareInFrame(s, around, close) != RS_ACCEPTED) continue;
        count += 1.0;
        diffuseCount += rsHasDiffuse(around) ? 1.0 : 0.0;
        RsLobes other = rsLoadLit(uvec2(at));
        lit.diffuse += other.diffuse;
        lit.specular += other.specular;
        if (distances) far += rsLitDistance(s, uvec2(at));
    }
    shading = rsNoLight();
    if (count == 0.0 || (diffuseCount == 0.0 && rsHasDiffuse(s))) return false;
    lit.diffuse = rsHasDiffuse(s) ? lit.diffuse / max(diffuseCount, 1.0) : vec3(0.0);
    lit.specular /= count;
    float distance = far.y > 0.0 ? far.x / far.y : RS_FARTHEST_HIT;
    RsLobes factors = rsBridgeLobeFactors(s);
    shading = RsShading(lit.diffuse * factors.diffuse + lit.specular * factors.specular,
                        rsLobe(lit.diffuse, distance), rsLobe(lit.specular, distance));
    return true;
}

#endif
