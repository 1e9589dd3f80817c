// Reservoirs: making and reading them. The struct is in restir/shared/di.h.
#ifndef RESTIR_DI_RESERVOIR_GLSL
#define RESTIR_DI_RESERVOIR_GLSL
#include "restir/core/math.glsl"
#include "restir/shared/di.h"
#include "restir/shared/scene.h"

#define RS_MAX_CONFIDENCE 0xffffu

// Hook of the passes: a weight that was not finite or negative.
void rsOnRejectedWeight();

bool rsHasSample(RsReservoir r) { return r.light != RS_NO_LIGHT && r.ucw > 0.0; }
uint rsConfidence(RsReservoir r) { return r.confidence & 0xffffu; }
uint rsAge(RsReservoir r) { return r.confidence >> 16u; }

RsReservoir rsEmptyReservoir(uint confidence) {
    return RsReservoir(RS_NO_LIGHT, 0u, 0.0, min(confidence, RS_MAX_CONFIDENCE));
}

// The only way to a stored weight: what is not finite and >= 0 becomes 0, its confidence kept.
RsReservoir rsMakeReservoir(uint light, uint uv, float ucw, uint confidence, uint age) {
    if (!rsIsWeight(ucw)) {
        rsOnRejectedWeight();
        ucw = 0.0;
    }
    if (ucw == 0.0) return rsEmptyReservoir(confidence);
    return RsReservoir(light, uv, ucw, min(confidence, RS_MAX_CONFIDENCE) | (min(age, 0xffffu) << 16u));
}

#endif
