// Reservoirs of indirect light, and where what they bring goes.
#include "restir/gi/room.glsl"

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
float rsStaleShare() { return rsFrame.giStale; }
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

layout(set = RS_SET, binding = RS_BIND_INDIRECT_DIFFUSE) uniform writeonly image2D rsIndirectDiffuseImage;
layout(set = RS_SET, binding = RS_BIND_INDIRECT_SPECULAR) uniform writeonly image2D rsIndirectSpecularImage;

vec4 rsIndirectOutput(vec4 sum) { return vec4(sum.rgb * rsFrame.exposure, rsMeanDistance(sum)); }
void rsShadeIndirect(uvec2 pixel, RsShading shading, inout RsRandom random) {
    rsAddIndirect(pixel, shading.radiance, random);
    ivec2 at = ivec2(pixel + rsFrame.outputOrigin);
    if ((rsFrame.flags & RS_FRAME_INDIRECT_DIFFUSE) != 0u)
        imageStore(rsIndirectDiffuseImage, at, rsIndirectOutput(shading.diffuse));
    if ((rsFrame.flags & RS_FRAME_INDIRECT_SPECULAR) != 0u)
        imageStore(rsIndirectSpecularImage, at, rsIndirectOutput(shading.specular));
}
