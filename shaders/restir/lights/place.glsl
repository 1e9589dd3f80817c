// Where lights are: leaves of the tree, and their order.
#ifndef RESTIR_LIGHTS_PLACE_GLSL
#define RESTIR_LIGHTS_PLACE_GLSL
#include "restir/lights/extent.glsl"
#include "restir/lights/tree.glsl"

RsTreeNode rsTreeLeaf(RsPackedLight light) {
    uint kind = light.kindAndTexture & RS_LIGHT_KIND_MASK;
    float edges = dot(light.edge1, light.edge1) + dot(light.edge2, light.edge2);
    RsTreeNode leaf = RsTreeNode(light.position, 0.0, light.selection);
    float spread = 0.0;
    if (!rsIsFinite(kind)) return RsTreeNode(vec3(0.0), 0.0, 0.0);
    if (kind == RS_LIGHT_TRIANGLE) {
        vec3 third = light.edge2 - light.edge1;
        leaf.mean += (light.edge1 + light.edge2) / 3.0;
        spread = (edges + dot(third, third)) / 36.0;
    } else if (kind == RS_LIGHT_RECTANGLE) {
        leaf.mean += 0.5 * (light.edge1 + light.edge2);
        spread = edges / 12.0;
    } else if (kind == RS_LIGHT_DISK) {
        spread = edges / 4.0;
    } else if (kind == RS_LIGHT_CAPSULE) {
        leaf.mean += 0.5 * light.edge1;
        spread = dot(light.edge1, light.edge1) / 12.0 + light.edge2.x * light.edge2.x;
    }
    leaf.radius = sqrt(spread);
    return leaf;
}

// Ten bits with two zeros behind each.
uint rsSpreadBits(uint x) {
    x = (x | x << 16u) & 0x030000ffu;
    x = (x | x << 8u) & 0x0300f00fu;
    x = (x | x << 4u) & 0x030c30c3u;
    return (x | x << 2u) & 0x09249249u;
}

#define RS_MORTON_LAST 0x3fffffffu

// Along the Morton curve through the cube that holds all; `high` and `low` as in rsSceneArea.
uint rsMortonKey(vec3 position, uvec3 high, uvec3 low) {
    vec3 from, size;
    for (int i = 0; i < 3; ++i) {
        from[i] = -rsFromOrdered(low[i]);
        size[i] = rsFromOrdered(high[i]) - from[i];
    }
    float edge = max(size.x, max(size.y, size.z));
    if (!(edge > 0.0 && edge < 3e38)) return 0u;
    uvec3 cell = uvec3(clamp((position - from) / edge, 0.0, 1.0) * 1023.0);
    return rsSpreadBits(cell.x) | rsSpreadBits(cell.y) << 1u | rsSpreadBits(cell.z) << 2u;
}

#endif
