// Rectangles by solid angle (Urena, Fajardo and King 2013), the angle from the closed form
//     omega = F(x1, y1) - F(x0, y1) - F(x1, y0) + F(x0, y0),    F(x, y) = atan(x y / (z sqrt(x^2 + y^2 + z^2))),
// over the corners of the rectangle, seen from the receiver, in the frame of its edges.
#ifndef RESTIR_LIGHTS_RECTANGLE_GLSL
#define RESTIR_LIGHTS_RECTANGLE_GLSL
#include "restir/core/math.glsl"
#include "restir/shared/lights.h"

// Below this solid angle points uniform over the area do as well, and omega is a difference of rounded numbers.
#define RS_LEAST_RECTANGLE 0.05
// Cosine between the edges of what is still a rectangle. Others are sampled by area.
#define RS_RECTANGLE_SKEW 1e-5

struct RsRectangleView {
    vec2 low, high;     // corners along the edges, metres from the receiver's foot
    float height;       // above the receiver's foot, > 0
    float start;        // F(x0, y1) - F(x0, y0)
    float solidAngle;   // 0: to be sampled by area
};

float rsCornerAngle(float x, float y, float z) { return rsAtan2(x * y, z * sqrt(x * x + y * y + z * z)); }

RsRectangleView rsViewRectangle(RsPackedLight light, vec3 receiver) {
    RsRectangleView view;
    view.solidAngle = 0.0;
    vec2 size = vec2(length(light.edge1), length(light.edge2));
    if (!(size.x > 0.0 && size.y > 0.0)) return view;
    vec3 x = light.edge1 / size.x, y = light.edge2 / size.y, corner = light.position - receiver;
    if (abs(dot(x, y)) > RS_RECTANGLE_SKEW) return view;
    view.low = vec2(dot(corner, x), dot(corner, y));
    view.high = view.low + size;
    view.height = abs(dot(corner, cross(x, y)));
    if (!(view.height > 1e-5 * max(size.x, size.y))) return view;   // edge on: no light
    view.start = rsCornerAngle(view.low.x, view.high.y, view.height) - rsCornerAngle(view.low.x, view.low.y, view.height);
    float end = rsCornerAngle(view.high.x, view.high.y, view.height) - rsCornerAngle(view.high.x, view.low.y, view.height);
    view.solidAngle = end - view.start;
    if (view.solidAngle < RS_LEAST_RECTANGLE) view.solidAngle = 0.0;
    return view;
}

vec2 rsSampleRectangleUv(RsRectangleView view, vec2 random) {
    float z2 = view.height * view.height;
    // Between the planes through y0 and y1 and left of x lies the angle A + const: sin of their slopes, then x of A.
    float angle = view.start + random.x * view.solidAngle;
    vec2 slope = vec2(view.low.y, view.high.y) * inversesqrt(z2 + vec2(view.low.y, view.high.y) * vec2(view.low.y, view.high.y));
    float sine = sin(angle), across = slope.y - slope.x * cos(angle);
    float cu = sine * inversesqrt(max(across * across + slope.x * slope.x * sine * sine, 1e-30));
    float x = clamp(view.height * cu * inversesqrt(max(1.0 - cu * cu, 1e-12)), view.low.x, view.high.x);
    // On the line of that x the sine of the angle to the foot is uniform.
    float foot2 = x * x + z2;
    vec2 ends = vec2(view.low.y, view.high.y);
    ends *= inversesqrt(foot2 + ends * ends);
    float h = mix(ends.x, ends.y, random.y);
    float y = clamp(h * sqrt(foot2) * inversesqrt(max(1.0 - h * h, 1e-12)), view.low.y, view.high.y);
    return (vec2(x, y) - view.low) / (view.high - view.low);
}

#endif
