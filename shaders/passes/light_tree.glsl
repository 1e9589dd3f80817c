// What the passes share that sort the lights along a curve and build the tree over them. Keys and lights are sorted by
// digits, the lowest first, each time keeping the order of equal ones (a radix sort): from one of two buffers to the other and back.
#include "passes/light_table.glsl"
#include "restir/lights/place.glsl"

#ifndef RS_TREE_COHERENT
#define RS_TREE_COHERENT
#endif
layout(set = 0, binding = RS_TABLE_BIND_TREE, scalar) RS_TREE_COHERENT buffer RsTree { uint rsTree[]; };
layout(set = 0, binding = RS_TABLE_BIND_COUNTS, scalar) buffer RsCounts { uint rsCounts[]; };   // [digit][block]

uint rsDigit(uint key) { return key >> rsPass.shift & (RS_TABLE_DIGITS - 1u); }
bool rsSortsBack() { return rsPass.shift / RS_TABLE_DIGIT_BITS % 2u != 0u; }
uvec2 rsLoadSorted(uint i) { return rsSortsBack() ? rsDeficit[i] : rsExcess[i]; }   // key, light
void rsStoreSorted(uint i, uvec2 entry) {
    if (rsSortsBack()) rsExcess[i] = entry;
    else rsDeficit[i] = entry;
}
