// Plain next-event estimation: lights drawn by power, a shadow ray each, no reuse. The baseline.
#ifndef RESTIR_DI_NEXT_EVENT_GLSL
#define RESTIR_DI_NEXT_EVENT_GLSL
#include "restir/di/direct.glsl"

RsShading rsDiNextEvent(RsSurface s, uint lightCount, uint samples, inout RsRandom random) {
    RsShading sum = rsNoLight();
    for (uint i = 0u; lightCount > 0u && i < samples; ++i) {
        RsPackedLight light = rsLoadLight(rsSampleLight(lightCount, random));
        float seen;
        uint uv = rsSampleLightUv(light, rsRayOrigin(s), random, seen);
        RsDirect direct = rsDirect(s, light, uv);
        float pdf = direct.target > 0.0 ? rsPdfLight(light.selection, light, uv, direct.incident, seen) : 0.0;
        if (pdf > 0.0 && rsUnoccluded(s, direct.incident)) rsAddLight(sum, s, direct, 1.0 / pdf);
    }
    return rsScale(sum, 1.0 / float(samples));
}

#endif
