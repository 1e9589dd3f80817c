#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/light_tree.glsl"

// Inner nodes of the tree of common prefixes, each on its own (Karras 2012, section 4). Keys may be equal: what follows them
// is their place in the order.
int rsCommonBits(uint i, int j) {
    if (j < 0 || j >= int(rsPass.columns)) return -1;
    uint a = rsExcess[i].x, b = rsExcess[uint(j)].x;   // where the sort ends
    return a != b ? 31 - findMSB(a ^ b) : 63 - findMSB(i ^ uint(j));
}

// The last of a node's keys, in the direction in which they lie from the first.
int rsFarEnd(uint first, int direction) {
    int outside = rsCommonBits(first, int(first) - direction), length = 2;
    while (rsCommonBits(first, int(first) + length * direction) > outside) length *= 2;
    int inside = 0;
    for (int step = length / 2; step > 0; step /= 2)
        if (rsCommonBits(first, int(first) + (inside + step) * direction) > outside) inside += step;
    return int(first) + inside * direction;
}

// The last key of the first child.
int rsSplit(uint first, int last, int direction) {
    int whole = rsCommonBits(first, last), length = abs(last - int(first)), inside = 0, step = length;
    do {
        step = (step + 1) / 2;
        if (rsCommonBits(first, int(first) + (inside + step) * direction) > whole) inside += step;
    } while (step > 1);
    return int(first) + inside * direction + min(direction, 0);
}

void rsStoreChild(uint slot, uint child, bool leaf) {
    uint columns = rsPass.columns;
    rsTree[rsTreeBelow(columns, slot)] = leaf ? RS_TREE_LEAF | rsExcess[child].y : child;
    rsTree[leaf ? rsTreeSlotOfLight(columns, rsExcess[child].y) : rsTreeSlotOfNode(columns, child)] = slot;
}

void main() {
    for (uint k = 0u; k < RS_TABLE_ITEMS; ++k) {
        uint node = rsItem(k);
        if (node >= rsPass.columns - 1u) continue;
        int direction = rsCommonBits(node, int(node) + 1) > rsCommonBits(node, int(node) - 1) ? 1 : -1;
        int end = rsFarEnd(node, direction), split = rsSplit(node, end, direction);
        rsStoreChild(2u * node, uint(split), min(int(node), end) == split);
        rsStoreChild(2u * node + 1u, uint(split + 1), max(int(node), end) == split + 1);
        rsDeficit[node].x = 0u;   // children that are there: lights.nodes
    }
}
