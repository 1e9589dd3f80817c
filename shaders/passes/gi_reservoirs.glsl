// Reservoirs of indirect light, and where what they bring goes.
#include "restir/gi/own.glsl"
#include "restir/gi/room.glsl"
#include "passes/lit.glsl"

layout(set = RS_SET, binding = RS_BIND_GI_RESERVOIRS, scalar) buffer RsGiReservoirs { uvec4 at[]; } rsGiReservoirs[2 * RS_GI_STREAMS];

RsGiReservoir rsLoadGiReservoir(uint which, uint i) {
    uint first = RS_GI_STREAMS * which;
    uvec4 a = rsGiReservoirs[first].at[i], b = rsGiReservoirs[first + 1u].at[i], c = rsGiReservoirs[first + 2u].at[i];
    return RsGiReservoir(uintBitsToFloat(a.xyz), a.w, b, c.xy, uintBitsToFloat(c.z), c.w);
}
void rsStoreGiReservoir(uint which, uint i, RsGiReservoir r) {
    uint first = RS_GI_STREAMS * which;
    rsGiReservoirs[first].at[i] = uvec4(floatBitsToUint(r.position), r.geometricNormal);
    rsGiReservoirs[first + 1u].at[i] = r.surface;
    rsGiReservoirs[first + 2u].at[i] = uvec4(r.arrival, floatBitsToUint(r.ucw), r.confidence);
}
void rsScaleGiReservoir(uint which, uint i, float factor) {
    uint at = RS_GI_STREAMS * which + 2u;
    rsGiReservoirs[at].at[i].z = floatBitsToUint(uintBitsToFloat(rsGiReservoirs[at].at[i].z) * factor);
}
float rsStaleShare() { return rsFrame.giStale; }
#ifndef RS_PASS_TEMPORAL
bool rsStands(bool previous) { return true; }   // all of one frame
#endif
RsGiReservoir rsLoadGiSource(uvec2 pixel) { return rsLoadGiReservoir(rsPass.source, rsIndex(pixel)); }
// The source buffer as the previous frame left it, without what last frame's pixels count as unable to find: weights that do not
// ask for a sample's own target would let that grow without end.
RsGiReservoir rsLoadGiHistory(uvec2 pixel) {
    RsGiReservoir r = rsLoadGiReservoir(rsPass.source, rsPreviousIndex(pixel));
    if (rsFrame.giStale == 0.0 && (r.surface.z & RS_GI_FOLLOWED) != 0u) r.ucw = 0.0;
    r.confidence = min(rsConfidence(r), rsFrame.gi.maxHistory) | (min(rsAge(r) + 1u, 0xffffu) << 16u);
    return r;
}

void rsAddIndirect(uvec2 pixel, vec3 light, inout RsRandom random) {
    if (light == vec3(0.0)) return;
    rsSurfacesFrame[rsIndex(pixel)].y = rsPackOwnLight(rsLoadOwnLight(pixel) + light, random);
}

layout(set = RS_SET, binding = RS_BIND_INDIRECT_DIFFUSE) uniform writeonly image2D rsIndirectDiffuseImage;
layout(set = RS_SET, binding = RS_BIND_INDIRECT_SPECULAR) uniform writeonly image2D rsIndirectSpecularImage;

// What gi.fill takes from the pixels that a checkerboard lights, where direct light has no reservoirs as yet.
void rsStoreLit(uvec2 pixel, RsShading shading) {
    uint i = rsIndex(pixel);
    uvec2 lit = rsPackLit(shading);
    rsReservoirs[rsFrame.giScratch].at[i].light = lit.x;
    rsReservoirs[rsFrame.giScratch].at[i].uv = lit.y;
    rsReservoirs[rsFrame.giScratch].at[i].ucw = rsMeanDistance(shading.diffuse + shading.specular);
}
RsLobes rsLoadLit(uvec2 pixel) {
    uint i = rsIndex(pixel);
    return rsUnpackLit(uvec2(rsReservoirs[rsFrame.giScratch].at[i].light, rsReservoirs[rsFrame.giScratch].at[i].uv));
}
vec2 rsLitDistance(RsSurface s, uvec2 pixel) {
    RsLobes lit = rsLoadLit(pixel);
    return rsLuminance(lit.diffuse + lit.specular) * vec2(rsReservoirs[rsFrame.giScratch].at[rsIndex(pixel)].ucw, 1.0);
}

// The own path's part, which gi.candidates adds to the pixel's light at once; its lobes wait for those of the reused one.
float rsOwnPart(RsSurface s) { return s.valid && (rsFrame.flags & RS_FRAME_OWN_PATH) != 0u ? rsOwnShare(s) : 0.0; }
void rsShadeOwn(uvec2 pixel, RsSurface s, RsShading fresh, inout RsRandom random) {
    float own = rsOwnPart(s);
    if (!(own > 0.0)) return;
    fresh = rsScale(fresh, own);
    rsAddIndirect(pixel, fresh.radiance, random);
    if (rsWantsLobes()) rsStoreLit(pixel, fresh);
}
RsShading rsWithOwn(uvec2 pixel, RsSurface s, RsShading reused) {
    float own = rsOwnPart(s);
    if (!(own > 0.0)) return reused;
    reused = rsScale(reused, 1.0 - own);
    if (!rsWantsLobes()) return reused;
    RsLobes fresh = rsLoadLit(pixel);
    float distance = rsReservoirs[rsFrame.giScratch].at[rsIndex(pixel)].ucw;
    reused.diffuse += rsLobe(fresh.diffuse, distance);
    reused.specular += rsLobe(fresh.specular, distance);
    return reused;
}

vec4 rsIndirectOutput(vec4 sum) { return vec4(sum.rgb * rsFrame.exposure, rsMeanDistance(sum)); }
void rsShadeIndirect(uvec2 pixel, RsShading shading, inout RsRandom random) {
    rsAddIndirect(pixel, shading.radiance, random);
    if (rsFrame.gi.field != RS_FIELD_ALL) rsStoreLit(pixel, shading);
    ivec2 at = ivec2(pixel + rsFrame.outputOrigin);
    if ((rsFrame.flags & RS_FRAME_INDIRECT_DIFFUSE) != 0u)
        imageStore(rsIndirectDiffuseImage, at, rsIndirectOutput(shading.diffuse));
    if ((rsFrame.flags & RS_FRAME_INDIRECT_SPECULAR) != 0u)
        imageStore(rsIndirectSpecularImage, at, rsIndirectOutput(shading.specular));
}
