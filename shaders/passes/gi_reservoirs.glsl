// Reservoirs of indirect light, and where what they bring goes.
#include "restir/gi/room.glsl"

layout(set = RS_SET, binding = RS_BIND_GI_RESERVOIRS, scalar) buffer RsGiReservoirs { uvec4 at[]; } rsGiReservoirs[4];

RsGiReservoir rsLoadGiReservoir(uint which, uint i) {
    uvec4 a = rsGiReservoirs[2u * which].at[i], b = rsGiReservoirs[2u * which + 1u].at[i];
    return RsGiReservoir(uintBitsToFloat(a.xyz), a.w, b.xy, uintBitsToFloat(b.z), b.w);
}
void rsStoreGiReservoir(uint which, uint i, RsGiReservoir r) {
    rsGiReservoirs[2u * which].at[i] = uvec4(floatBitsToUint(r.position), r.normal);
    rsGiReservoirs[2u * which + 1u].at[i] = uvec4(r.radiance, floatBitsToUint(r.ucw), r.confidence);
}
RsGiReservoir rsLoadGiSource(uvec2 pixel) { return rsLoadGiReservoir(rsPass.source, rsIndex(pixel)); }
// The source buffer as the previous frame left it.
RsGiReservoir rsLoadGiHistory(uvec2 pixel) {
    RsGiReservoir r = rsLoadGiReservoir(rsPass.source, rsPreviousIndex(pixel));
    r.confidence = min(rsConfidence(r), rsFrame.gi.maxHistory) | (min(rsAge(r) + 1u, 0xffffu) << 16u);
    return r;
}

void rsAddIndirect(uvec2 pixel, vec3 light, inout RsRandom random) {
    if (light == vec3(0.0)) return;
    rsSurfacesFrame[rsIndex(pixel)].y = rsPackOwnLight(rsLoadOwnLight(pixel) + light, random);
}

layout(set = RS_SET, binding = RS_BIND_RESERVOIRS, scalar) buffer RsScratch { uvec4 at[]; } rsScratch[2];
layout(set = RS_SET, binding = RS_BIND_INDIRECT_DIFFUSE) uniform writeonly image2D rsIndirectDiffuseImage;
layout(set = RS_SET, binding = RS_BIND_INDIRECT_SPECULAR) uniform writeonly image2D rsIndirectSpecularImage;

// The lobes of what no reservoir holds, for the pass that shades.
void rsStoreRest(uvec2 pixel, RsShading rest, inout RsRandom random) {
    rsScratch[rsFrame.giScratch].at[rsIndex(pixel)] =
        uvec4(rsPackSignedRadiance(rest.diffuse.rgb, vec3(rsNext2(random), rsNext(random))),
              rsPackSignedRadiance(rest.specular.rgb, vec3(rsNext2(random), rsNext(random))), floatBitsToUint(rest.diffuse.w), 0u);
}
RsShading rsLoadRest(uvec2 pixel) {
    uvec4 rest = rsScratch[rsFrame.giScratch].at[rsIndex(pixel)];
    float distance = uintBitsToFloat(rest.z);
    return RsShading(vec3(0.0), vec4(rsUnpackSignedRadiance(rest.x), distance), vec4(rsUnpackSignedRadiance(rest.y), distance));
}

// What is reused says where light comes from, where there is any.
vec4 rsIndirectOutput(vec4 reused, vec4 fresh) {
    float distance = rsMeanDistance(reused);
    vec3 light = reused.rgb + fresh.rgb;
    if (!(distance > 0.0)) distance = light == vec3(0.0) ? 0.0 : min(fresh.w, RS_FARTHEST_HIT);
    return vec4(light * rsFrame.exposure, distance);
}
void rsWriteIndirectLobes(uvec2 pixel, RsShading reused, RsShading fresh) {
    ivec2 at = ivec2(pixel + rsFrame.outputOrigin);
    if ((rsFrame.flags & RS_FRAME_INDIRECT_DIFFUSE) != 0u)
        imageStore(rsIndirectDiffuseImage, at, rsIndirectOutput(reused.diffuse, fresh.diffuse));
    if ((rsFrame.flags & RS_FRAME_INDIRECT_SPECULAR) != 0u)
        imageStore(rsIndirectSpecularImage, at, rsIndirectOutput(reused.specular, fresh.specular));
}

// The last pass of reuse.
void rsShadeIndirect(uvec2 pixel, RsShading reused, inout RsRandom random) {
    rsAddIndirect(pixel, reused.radiance, random);
    if (rsWantsLobes()) rsWriteIndirectLobes(pixel, reused, rsLoadRest(pixel));
}
