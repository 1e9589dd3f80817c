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
