#version 460
#extension GL_GOOGLE_include_directive : require
#define RS_PASS_RAYS
#define RS_PASS_INDIRECT
#define RS_PASS_TEMPORAL
#include "passes/bindings.glsl"
#include "passes/gi_reservoirs.glsl"
#include "passes/back_project.glsl"
#include "restir/di/temporal.glsl"
#include "restir/gi/stands.glsl"

bvec2 rsStanding = bvec2(true);
bool rsStands(bool previous) { return previous ? rsStanding.x : rsStanding.y; }

void main() {
    uvec2 pixel = rsPixelOn(rsFrame.gi.field);
    if (!rsInside(pixel)) return;
    RsSurface s = rsLoadSurface(pixel);
    if (!s.valid) return;
    RsRandom random = rsRandom(pixel, rsFrame.seed, RS_STAGE_GI + RS_STAGE_TEMPORAL);
    RsGiReservoir fresh = rsLoadGiReservoir(rsPass.target, rsIndex(pixel));
    RsNeighbourhood where = rsFindHistory(s, rsBackProject(pixel, s), rsFrame.gi, random);
    bool traced = rsFrame.gi.visibility == RS_VISIBILITY_TRACED;
    if (traced && where.accepted != 0u && (rsFrame.flags & RS_FRAME_MOVED) != 0u)
        rsStanding = rsStandBetween(fresh, rsLoadGiHistory(where.pixel));
    RsGiReservoir kept = rsCombine(s, fresh, where, rsFrame.gi.weights, traced, random).reservoir;
    rsStoreGiReservoir(rsPass.target, rsIndex(pixel), kept);
}
