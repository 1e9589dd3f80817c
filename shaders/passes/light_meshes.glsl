// Lights that are triangles of the scene, which is set 1.
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require
#extension GL_EXT_nonuniform_qualifier : require
#define RS_PASS_EMITTERS
#include "passes/light_table.glsl"
#include "restir_bridge.glsl"

layout(set = 0, binding = RS_TABLE_BIND_MESHES, scalar) readonly buffer RsMeshes { RsLightMesh rsMeshes[]; };
layout(set = 0, binding = RS_TABLE_BIND_MEANS, scalar) buffer RsMeans { vec3 rsMeans[]; };

// The triangle of a light; black where the id is between meshes.
RsEmitter rsEmitterOf(uint id) {
    uint first = 0u, last = rsPass.meshes;
    while (first < last) {   // the first mesh that begins after it
        uint middle = (first + last) / 2u;
        if (rsMeshes[middle].firstLight <= id) first = middle + 1u;
        else last = middle;
    }
    if (first == 0u) return rsNoEmitter();
    RsLightMesh mesh = rsMeshes[first - 1u];
    uint primitive = id - mesh.firstLight;
    if (primitive >= mesh.triangles) return rsNoEmitter();
    return rsBridgeEmitter(mesh.record, primitive);
}
