// Between pixels, linear depth and world space. RsView is described in restir/shared/frame.h.
#ifndef RESTIR_CORE_VIEW_GLSL
#define RESTIR_CORE_VIEW_GLSL
#include "restir/shared/frame.h"

// `pixel` counts from the top left corner; the centre of the first pixel is (0.5, 0.5).
vec3 rsPositionFromDepth(RsView view, uvec2 extent, vec2 pixel, float depth) {
    vec2 ndc = pixel / vec2(extent) * 2.0 - 1.0 - view.jitter;
    float w = mix(1.0, depth, view.perspective);
    vec2 xy = (ndc * w - view.projection.zw * depth - view.translation) / view.projection.xy;
    return view.eye + view.axisX * xy.x + view.axisY * xy.y + view.axisZ * (view.zSign * depth);
}

vec3 rsTowardsEye(RsView view, vec3 position) {
    return view.perspective > 0.5 ? normalize(view.eye - position) : -view.zSign * normalize(view.axisZ);
}

float rsDepthOf(RsView view, vec3 position) { return view.zSign * dot(view.viewFromWorld[2], vec4(position, 1.0)); }

// Position in pixels, jitter included.
vec2 rsPixelOf(RsView view, uvec2 extent, vec3 position) {
    vec2 xy = vec2(dot(view.viewFromWorld[0], vec4(position, 1.0)), dot(view.viewFromWorld[1], vec4(position, 1.0)));
    float depth = rsDepthOf(view, position);
    float w = mix(1.0, depth, view.perspective);
    vec2 ndc = (xy * view.projection.xy + view.projection.zw * depth + view.translation) / w + view.jitter;
    return (ndc * 0.5 + 0.5) * vec2(extent);
}

// Linear depth from what the rasteriser stored.
float rsDepthFromDevice(RsView view, float device) {
    vec4 t = view.depthTerms;   // device = (t.x z + t.y) / (t.z z + t.w)
    return view.zSign * (t.y - device * t.w) / (device * t.z - t.x);
}

#endif
