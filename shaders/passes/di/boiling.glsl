#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/bindings.glsl"
#include "restir/di/boiling.glsl"
#include "passes/boil.glsl"

void main() {
    uvec2 pixel = rsPixel();
    float contribution = 0.0;
    if (rsInside(pixel)) {
        RsSurface s = rsLoadSurface(pixel);
        if (s.valid) contribution = rsContribution(s, rsReservoirs[rsPass.target].at[rsIndex(pixel)]);
    }
    float factor = rsBoil(contribution, rsFrame.di.boilingFilter);
    if (factor < 1.0) rsReservoirs[rsPass.target].at[rsIndex(pixel)].ucw *= factor;
}
