// Plain next-event estimation: lights drawn by power, a shadow ray each, no reuse. The baseline.
#ifndef RESTIR_DI_NEXT_EVENT_GLSL
#define RESTIR_DI_NEXT_EVENT_GLSL
#include "restir/di/direct.glsl"

RsShading rsDiNextEvent(RsSurface s, uint lightCount, uint samples, inout RsRandom random) {
    RsShading sum = rsNoLight();
    for (uint i = 0u; lightCount > 0u && i < samples; ++i) {
        RsPackedLight light = rsLoadLight(rsSampleLight(lightCount, random));
        RsDirect direct = rsDirect(s, light, rsSampleLightUv(light, rsNextBits(random)));
        if (direct.target > 0.0 && light.selection > 0.0 && rsUnoccluded(s, direct.incident))
            rsAddLight(sum, s, direct, 1.0 / light.selection);
    }
    return rsDivide(sum, float(samples));
}

#endif
