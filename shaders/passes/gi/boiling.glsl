#version 460
#extension GL_GOOGLE_include_directive : require
#define RS_PASS_INDIRECT
#include "passes/bindings.glsl"
#include "passes/gi_reservoirs.glsl"
#include "restir/di/boiling.glsl"
#include "passes/boil.glsl"

void main() {
    uvec2 pixel = rsPixelOn(rsFrame.gi.field);
    float contribution = 0.0;
    if (rsInside(pixel)) {
        RsSurface s = rsLoadSurface(pixel);
        if (s.valid) contribution = rsContribution(s, rsLoadGiReservoir(rsPass.target, rsIndex(pixel)));
    }
    float factor = rsBoil(contribution, rsFrame.gi.boilingFilter);
    if (factor < 1.0) rsScaleGiReservoir(rsPass.target, rsIndex(pixel), factor);
}
