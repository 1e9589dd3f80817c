#version 460
#extension GL_GOOGLE_include_directive : require
#define RS_TREE_COHERENT coherent
#include "passes/light_tree.glsl"

RsTreeNode rsLoadNode(uint slot) {
    uint at = 4u * slot;
    return rsUnpackTreeNode(uvec4(rsTree[at], rsTree[at + 1u], rsTree[at + 2u], rsTree[at + 3u]));
}
void rsStoreNode(uint slot, RsTreeNode node) {
    uvec4 bits = rsPackTreeNode(node);
    for (uint k = 0u; k < 4u; ++k) rsTree[4u * slot + k] = bits[k];
}

// From each leaf up, as far as both children are there: whoever comes second goes on. What a node becomes does not depend on
// who that is.
void main() {
    uint columns = rsPass.columns;
    for (uint k = 0u; k < RS_TABLE_ITEMS; ++k) {
        uint light = rsItem(k);
        if (light >= columns) continue;
        RsTreeNode node = RsTreeNode(vec3(0.0), 0.0, 0.0);
        if (light < rsPass.lights) node = rsTreeLeaf(rsLights[light]);
        uint slot = rsTree[rsTreeSlotOfLight(columns, light)];
        for (uint depth = 0u; depth < RS_TREE_DEEPEST; ++depth) {
            rsStoreNode(slot, node);
            memoryBarrierBuffer();
            uint parent = slot / 2u;
            if (atomicAdd(rsDeficit[parent].x, 1u) == 0u) break;
            memoryBarrierBuffer();
            node = rsJoin(rsLoadNode(2u * parent), rsLoadNode(2u * parent + 1u));
            if (parent == 0u) {
                rsStoreNode(rsTreeRoot(columns), node);
                break;
            }
            slot = rsTree[rsTreeSlotOfNode(columns, parent)];
        }
    }
}
