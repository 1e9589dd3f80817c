#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/light_meshes.glsl"
#include "restir/lights/texture_mean.glsl"

shared vec4 rsSums[RS_TABLE_GROUP];

// A light for each workgroup.
void main() {
    uint id = gl_WorkGroupID.y * RS_TABLE_ROW + gl_WorkGroupID.x, self = gl_LocalInvocationIndex;
    if (id >= rsPass.meshLights) return;
    RsEmitter emitter = rsEmitterOf(id);
    if (emitter.texture == RS_NO_TEXTURE) return;
    uvec2 size = rsBridgeTextureSize(emitter.texture);
    RsTexels texels = rsTexelsUnder(emitter.uvs, size);
    vec4 sum = vec4(0.0);
    for (uint i = self; i < texels.extent.x * texels.extent.y; i += RS_TABLE_GROUP) {
        vec2 centre = vec2(texels.low) + vec2(i % texels.extent.x, i / texels.extent.x) + 0.5;
        float share = rsTexelShare(texels, centre);
        if (share > 0.0) sum += share * vec4(rsRadianceOf(rsBridgeTexture(emitter.texture, centre / vec2(size)).rgb), 1.0);
    }
    rsSums[self] = sum;
    for (uint distance = RS_TABLE_GROUP / 2u; distance > 0u; distance /= 2u) {
        barrier();
        if (self < distance) rsSums[self] += rsSums[self + distance];
    }
    if (self == 0u) rsMeans[id] = rsSums[0].rgb / max(rsSums[0].w, 1e-30);
}
