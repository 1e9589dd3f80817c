// ReSTIR GI: what its passes and the host agree on.
#ifndef RESTIR_SHARED_GI_H
#define RESTIR_SHARED_GI_H
#include "restir/shared/types.h"
RS_SHARED_BEGIN

// One path kept for one pixel: its second vertex and what leaves that. 32 bytes, stored as two streams of 16.
struct RsGiReservoir {
    vec3 position;     // of the second vertex, world space
    uint normal;       // geometric, on the path's side; 2 x 16-bit octahedral
    uvec2 radiance;    // that leaves it for the first: 3 x 16-bit mantissas under one exponent
    float ucw;         // unbiased contribution weight W, m^2; 0: no sample. Checked before the store
    uint confidence;   // as in RsReservoir
};

RS_SHARED_END
#endif
