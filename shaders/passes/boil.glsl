// A tile is a workgroup: sums over shared memory, in one order, are the same at any subgroup size.
const uint kTile = gl_WorkGroupSize.x * gl_WorkGroupSize.y;
shared float rsTile[kTile];

// Called by all of a workgroup. What is left of this invocation's contribution (rsBoilingFactor).
float rsBoil(float contribution, float strength) {
    uint self = gl_LocalInvocationIndex;
    rsTile[self] = contribution;
    barrier();
    float sum = 0.0;
    uint count = 0u;
    for (uint i = 0u; i < kTile; ++i) {
        if (i == self || rsTile[i] == 0.0) continue;
        sum += rsTile[i];
        ++count;
    }
    return rsBoilingFactor(contribution, sum, count, strength);
}
