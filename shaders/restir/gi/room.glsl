// Included before a stage of reuse (restir/di: temporal, spatial, boiling, shade): from here on its reservoirs are those of
// indirect light.
#ifndef RESTIR_GI_ROOM_GLSL
#define RESTIR_GI_ROOM_GLSL
#include "restir/di/sample.glsl"
#include "restir/gi/reservoir.glsl"

#define RsReservoir RsGiReservoir
#define rsEmptyReservoir rsEmptyGiReservoir
#define rsLoadSource rsLoadGiSource
#define rsLoadHistory rsLoadGiHistory

#endif
