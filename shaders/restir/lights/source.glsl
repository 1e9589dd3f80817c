// Where candidates come from: the power table for some, the tree for others. A light's probability is that of the mixture,
// (1 - s) P_power + s P_tree, whichever of them it came from, so nothing has to be weighed against anything. s and P_tree are
// the receiver's.
#ifndef RESTIR_LIGHTS_SOURCE_GLSL
#define RESTIR_LIGHTS_SOURCE_GLSL
#include "restir/lights/table.glsl"
#include "restir/lights/tree.glsl"

struct RsLightSource {
    uint count;        // one more than the largest id
    float treeShare;   // s in [0, 0.9]; 0 where there is no tree
};

// For one receiver, of what is for any.
RsLightSource rsSourceAt(RsLightSource source, vec3 receiver) {
    if (source.count > 0u && source.treeShare > 0.0)
        source.treeShare = rsTreeShare(source.treeShare, receiver, rsColumns(source.count));
    return source;
}

struct RsLightDraw {
    uint light;           // RS_NO_LIGHT: nothing was drawn
    float treeChance;     // < 0: not known
};

// `source`, here and below: the receiver's.
RsLightDraw rsDrawLightFrom(RsLightSource source, vec3 receiver, vec3 normal, inout RsRandom random) {
    RsLightDraw draw = RsLightDraw(RS_NO_LIGHT, -1.0);
    if (source.treeShare > 0.0 && rsNext(random) < source.treeShare)
        draw.light = rsSampleTree(receiver, normal, rsColumns(source.count), random, draw.treeChance);
    else draw.light = rsSampleLight(source.count, random);
    return draw;
}

// Of a light, however it was found. `selection` is the light's.
float rsLightChance(RsLightSource source, RsLightDraw draw, float selection, vec3 receiver, vec3 normal) {
    if (!(source.treeShare > 0.0)) return selection;
    if (draw.treeChance < 0.0) draw.treeChance = rsTreeChance(draw.light, receiver, normal, rsColumns(source.count));
    return mix(selection, draw.treeChance, source.treeShare);
}
float rsLightChance(RsLightSource source, uint light, float selection, vec3 receiver, vec3 normal) {
    return rsLightChance(source, RsLightDraw(light, -1.0), selection, receiver, normal);
}

#endif
