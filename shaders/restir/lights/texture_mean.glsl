// The texels that linear filtering can mix into what a triangle shows: those less than a texel away from it. A mean of 0
// over them, each with some share, says that the triangle is black.
#ifndef RESTIR_LIGHTS_TEXTURE_MEAN_GLSL
#define RESTIR_LIGHTS_TEXTURE_MEAN_GLSL

struct RsTexels {
    vec2 corners[3];   // of the triangle, in texels
    ivec2 low;         // of the box
    uvec2 extent;
    bool all;          // the box is the whole texture, which the triangle repeats
};

RsTexels rsTexelsUnder(vec2 uvs[3], uvec2 size) {
    RsTexels texels;
    for (int i = 0; i < 3; ++i) texels.corners[i] = uvs[i] * vec2(size);
    vec2 low = floor(min(min(texels.corners[0], texels.corners[1]), texels.corners[2])) - 1.0;
    vec2 high = ceil(max(max(texels.corners[0], texels.corners[1]), texels.corners[2])) + 1.0;
    // Beyond 2^22 texels from the origin, centres of texels are no floats; nor is NaN in any range.
    bool near = all(lessThan(abs(low), vec2(4194304.0))) && all(lessThan(abs(high), vec2(4194304.0)));
    texels.all = !near || any(greaterThan(high - low, vec2(size) + 2.0));
    texels.low = texels.all ? ivec2(0) : ivec2(low);
    texels.extent = texels.all ? size : uvec2(high - low);
    return texels;
}

// How much of what linear filtering spreads of a texel falls on the triangle: exact at edges along an axis, and 0 only
// where nothing does.
float rsTexelShare(RsTexels texels, vec2 centre) {
    if (texels.all) return 1.0;
    vec2 a = texels.corners[1] - texels.corners[0], b = texels.corners[2] - texels.corners[0];
    float turn = a.x * b.y < a.y * b.x ? -1.0 : 1.0, inside = 1.0;   // texels, at most 1
    for (int i = 0; i < 3; ++i) {
        vec2 edge = texels.corners[(i + 1) % 3] - texels.corners[i], d = centre - texels.corners[i];
        float reach = abs(edge.x) + abs(edge.y);
        if (reach > 0.0) inside = min(inside, turn * (edge.x * d.y - edge.y * d.x) / reach);
    }
    float outside = max(1.0 - abs(inside), 0.0);
    return inside > 0.0 ? 1.0 - 0.5 * outside * outside : 0.5 * outside * outside;
}

#endif
