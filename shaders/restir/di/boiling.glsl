// Boiling: a reservoir that got much of the light at once keeps it for as long as its history lasts, as a blotch. The filter
// cuts back what a reservoir brings to a multiple of what others near it do. It looks at what was sampled, so it is biased,
// always towards darkness. Cutting back leaves less error than dropping the sample does, at the same bias.
#ifndef RESTIR_DI_BOILING_GLSL
#define RESTIR_DI_BOILING_GLSL
#include "restir/di/sample.glsl"

// What a filter of strength 1 lets pass, in means of the others.
#define RS_BOILING_LIMIT 4.0

// p^ W, without visibility.
float rsContribution(RsSurface s, RsReservoir r) {
    return rsHasSample(r) ? rsEvaluate(s, r, false).target * r.ucw : 0.0;
}

// What is left of a contribution, in (0, 1]. `count` others near by bring something, together `sum`; without them nothing
// boils.
float rsBoilingFactor(float contribution, float sum, uint count, float strength) {
    float limit = RS_BOILING_LIMIT * sum / (strength * float(count));
    return count > 0u && contribution > limit ? limit / contribution : 1.0;
}

#endif
