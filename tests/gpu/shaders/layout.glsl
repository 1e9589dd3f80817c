#version 460
// Writes two of every shared struct, and lights as the passes read them from their stream of uvec4.
#extension GL_GOOGLE_include_directive : require
#include "passes/bindings.glsl"
#include "restir/shared/light_table.h"
#include "gpu/shaders/include/fill.glsl"

#define RS_OUT(BINDING, TYPE, NAME) \
    layout(set = 0, binding = BINDING, scalar) writeonly buffer TYPE##Out { TYPE NAME[2]; };
RS_OUT(0, RsReservoir, reservoirsOut)
RS_OUT(1, RsDiConstants, diOut)
RS_OUT(2, RsView, viewOut)
RS_OUT(3, RsFrame, frameOut)
RS_OUT(4, RsPass, passOut)
RS_OUT(5, RsCounters, countersOut)
RS_OUT(6, RsLoggedRay, raysOut)
RS_OUT(7, RsPackedLight, lightsOut)
RS_OUT(8, RsAliasEntry, aliasOut)
RS_OUT(9, RsInstance, instancesOut)
RS_OUT(10, RsMaterial, materialsOut)
layout(set = 0, binding = 11, scalar) readonly buffer Stream { uvec4 stream[]; };
layout(set = 0, binding = 12, scalar) writeonly buffer Streamed { RsPackedLight streamed[2]; };

RS_OUT(13, RsTablePass, tablePassesOut)
RS_OUT(14, RsTableState, tableStatesOut)
RS_OUT(15, RsEnvironmentTexel, texelsOut)
RS_OUT(16, RsLightMesh, lightMeshesOut)

#define RS_FILL(TYPE, FILL, NAME) \
    TYPE NAME##Value;             \
    FILL(NAME##Value, base);      \
    NAME[i] = NAME##Value;

void main() {
    if (gl_GlobalInvocationID.x >= 2u || gl_GlobalInvocationID.y != 0u) return;
    uint i = gl_GlobalInvocationID.x;
    int base = 1000 + 1000 * int(i);
    RS_FILL(RsReservoir, fillReservoir, reservoirsOut)
    RS_FILL(RsDiConstants, fillDi, diOut)
    RS_FILL(RsView, fillView, viewOut)
    RS_FILL(RsFrame, fillFrame, frameOut)
    RS_FILL(RsPass, fillPass, passOut)
    RS_FILL(RsCounters, fillCounters, countersOut)
    RS_FILL(RsLoggedRay, fillRay, raysOut)
    RS_FILL(RsPackedLight, fillLight, lightsOut)
    RS_FILL(RsAliasEntry, fillAlias, aliasOut)
    RS_FILL(RsInstance, fillInstance, instancesOut)
    RS_FILL(RsMaterial, fillMaterial, materialsOut)
    RS_FILL(RsTablePass, fillTablePass, tablePassesOut)
    RS_FILL(RsTableState, fillTableState, tableStatesOut)
    RS_FILL(RsEnvironmentTexel, fillTexel, texelsOut)
    RS_FILL(RsLightMesh, fillLightMesh, lightMeshesOut)
    uint s = i * RS_LIGHT_STRIDE;
    streamed[i] = rsUnpackLight(stream[s], stream[s + 1u], stream[s + 2u], stream[s + 3u], stream[s + 4u]);
}
