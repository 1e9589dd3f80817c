#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/light_meshes.glsl"

void main() {
    for (uint k = 0u; k < RS_TABLE_ITEMS; ++k) {
        uint id = rsItem(k);
        if (id >= rsPass.meshLights) continue;
        RsEmitter emitter = rsEmitterOf(id);
        rsLights[id] = rsEmitterLight(emitter, emitter.texture != RS_NO_TEXTURE ? rsMeans[id] : vec3(1.0));
    }
}
