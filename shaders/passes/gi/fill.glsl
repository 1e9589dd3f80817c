#version 460
#extension GL_GOOGLE_include_directive : require
#define RS_PASS_RAYS
#define RS_PASS_HITS
#define RS_PASS_INDIRECT
#include "passes/bindings.glsl"
#include "restir/gi/fill.glsl"
#include "passes/gi_reservoirs.glsl"

void main() {
    uvec2 pixel = rsPixelOn(rsOtherField(rsFrame.gi.field));
    if (!rsInside(pixel) || rsIsOnField(ivec2(pixel), rsFrame.gi.field)) return;
    RsSurface s = rsLoadSurface(pixel);
    RsRandom random = rsRandom(pixel, rsFrame.seed, RS_STAGE_GI + RS_STAGE_FILL);
    RsShading shading = rsNoLight();
    bool distances = (rsFrame.flags & (RS_FRAME_INDIRECT_DIFFUSE | RS_FRAME_INDIRECT_SPECULAR)) != 0u;
    RsLightSource source = RsLightSource(rsFrame.lightCount, rsFrame.gi.treeShare);
    if (s.valid) shading = rsGiFill(s, pixel, rsFrame.extent, source, rsFrame.giBounces, distances, rsFrame.gi, random);
    rsShadeIndirect(pixel, shading, random);
}
