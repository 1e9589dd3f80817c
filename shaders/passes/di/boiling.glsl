#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/bindings.glsl"
#include "restir/di/boiling.glsl"

// A tile is a workgroup: sums over shared memory, in one order, are the same at any subgroup size.
const uint kTile = gl_WorkGroupSize.x * gl_WorkGroupSize.y;
shared float rsTile[kTile];

void main() {
    uvec2 pixel = rsPixel();
    uint self = gl_LocalInvocationIndex;
    float contribution = 0.0;
    if (rsInside(pixel)) {
        RsSurface s = rsLoadSurface(pixel);
        if (s.valid) contribution = rsContribution(s, rsReservoirs[rsPass.target].at[rsIndex(pixel)]);
    }
    rsTile[self] = contribution;
    barrier();
    float sum = 0.0;
    uint count = 0u;
    for (uint i = 0u; i < kTile; ++i) {
        if (i == self || rsTile[i] == 0.0) continue;
        sum += rsTile[i];
        ++count;
    }
    float factor = rsBoilingFactor(contribution, sum, count, rsFrame.di.boilingFilter);
    if (factor < 1.0) rsReservoirs[rsPass.target].at[rsIndex(pixel)].ucw *= factor;
}
