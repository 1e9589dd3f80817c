#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/light_tree.glsl"

void main() {
    uvec3 high = uvec3(rsState.high[0], rsState.high[1], rsState.high[2]);
    uvec3 low = uvec3(rsState.low[0], rsState.low[1], rsState.low[2]);
    for (uint k = 0u; k < RS_TABLE_ITEMS; ++k) {
        uint column = rsItem(k), key = RS_MORTON_LAST;   // what is no light comes last
        if (column >= rsPass.columns) continue;
        if (column < rsPass.lights) {
            RsTreeNode leaf = rsTreeLeaf(rsLights[column]);
            if (leaf.power > 0.0) key = rsMortonKey(leaf.mean, high, low);
        }
        rsExcess[column] = uvec2(key, column);
    }
}
