// ReSTIR GI: what its passes and the host agree on.
#ifndef RESTIR_SHARED_GI_H
#define RESTIR_SHARED_GI_H
#include "restir/shared/types.h"
RS_SHARED_BEGIN

// One path kept for one pixel: its second vertex as a surface, and what arrives there: a point on a light, or what a path
// found that went on from there. 48 bytes, stored as RS_GI_STREAMS streams of 16.
struct RsGiReservoir {
    vec3 position;          // of the second vertex, world space
    uint geometricNormal;   // on the path's side; 2 x 16-bit octahedral
    uvec4 surface;          // the rest of it: normal, base colour, material and RS_GI_FOLLOWED, material id, as in RsPackedSurface
    uvec2 arrival;          // a light and the point on it, as in RsReservoir; or with RS_GI_FOLLOWED the direction that light comes
                            // from, 2 x 16-bit octahedral, and its colour over its largest channel, 3 x 10 bits
    float ucw;              // unbiased contribution weight W, m^2, times what the colour is over; 0: no sample. Checked before the
                            // store
    uint confidence;        // as in RsReservoir
};

RS_SHARED_END

#define RS_GI_STREAMS 3
#define RS_GI_FOLLOWED 0x80000000u   // in surface.z, where no surface has anything

#endif
