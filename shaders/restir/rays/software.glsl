// Ray backend: two levels of binary trees in storage buffers (restir/shared/bvh.h), walked in compute. Near children
// first, and no stack: a trail of one bit a level says whether the other child of that level is still to be visited, and
// entries lead back to their parents.
#ifndef RESTIR_RAYS_SOFTWARE_GLSL
#define RESTIR_RAYS_SOFTWARE_GLSL
#include "restir/rays/answers.glsl"
#include "restir/shared/bvh.h"

// What the includer binds.
uvec4 rsLoadBvhNode(uint vector);   // RsBvhNode[] in vectors of 16 bytes
uint rsLoadBvhLink(uint vector);    // the w of one
uvec4 rsLoadBvhCorner(uint corner, uint triangle);
uvec4 rsLoadBvhInstance(uint vector);   // RsBvhInstance[], likewise
uint rsBvhRoot(bool previous);

struct RsBvhRay {
    vec3 origin;
    vec3 direction;
    vec3 inverse;   // finite, so that no product with 0 is NaN
};

RsBvhRay rsBvhRay(vec3 origin, vec3 direction) {
    vec3 signs = mix(vec3(1.0), vec3(-1.0), lessThan(direction, vec3(0.0)));
    return RsBvhRay(origin, direction, signs / max(abs(direction), vec3(1e-30)));
}

// The exact box or a little more, as far as its own roundings go (a quotient may be off by 2.5 units in the last place). x:
// where the ray enters; x > y: it does not.
vec2 rsBvhBox(RsBvhRay ray, vec3 low, vec3 high, float tmax) {
    vec3 a = (low - ray.origin) * ray.inverse, b = (high - ray.origin) * ray.inverse;
    vec3 near = min(a, b), far = max(a, b);
    return vec2(max(max(near.x, near.y), max(near.z, 0.0)), min(1.000001 * min(min(far.x, far.y), far.z), tmax));
}

// On which side of an edge the ray passes. Of the edge turned round it is the negative, to the last bit, so that no ray slips
// through between two triangles (right at a corner one in hundreds may): nothing may be fused here. `sum`: of the edge's ends, from the ray's origin.
float rsBvhEdge(vec3 edge, vec3 sum, vec3 direction) {
    precise vec3 normal = edge.yzx * sum.zxy - edge.zxy * sum.yzx;
    precise float side = normal.x * direction.x + normal.y * direction.y + normal.z * direction.z;
    return side;
}

// False for all that is NaN. (Davidovic et al. 2012.)
bool rsBvhTriangle(RsBvhRay ray, vec3 a, vec3 b, vec3 c, float tmax, out float t, out vec2 barycentrics) {
    vec3 v0 = a - ray.origin, v1 = b - ray.origin, v2 = c - ray.origin;
    vec3 e0 = v2 - v0, e1 = v0 - v1;
    float u = rsBvhEdge(e0, v2 + v0, ray.direction);
    float v = rsBvhEdge(e1, v0 + v1, ray.direction);
    float w = rsBvhEdge(v1 - v2, v1 + v2, ray.direction);
    vec3 normal = cross(e0, e1);
    float slope = dot(normal, ray.direction);
    t = dot(normal, v0) / slope;
    float sum = u + v + w;
    barycentrics = vec2(u, v) / sum;
    bool inside = min(min(u, v), w) >= 0.0 || max(max(u, v), w) <= 0.0;
    return inside && sum != 0.0 && slope != 0.0 && t > 0.0 && t < tmax;
}

RsHit rsTrace(vec3 origin, vec3 direction, float tmax, bool any, bool previous) {
    RsHit hit = RsHit(-1.0, 0u, 0u, vec2(0.0));
    RsBvhRay ray = rsBvhRay(origin, direction);
    uint word = rsBvhRoot(previous);
    uint entry = 0u, trail = 0u;              // that led to the word; bit 0: the other child of its node waits
    uint outerEntry = 0u, outerTrail = 0u;    // of the instance that is being visited
    uint record = 0u;
    bool inside = false;
    while (true) {
        if (word < RS_BVH_LEAF) {
            uvec4 a = rsLoadBvhNode(4u * word), b = rsLoadBvhNode(4u * word + 1u);
            uvec4 c = rsLoadBvhNode(4u * word + 2u), d = rsLoadBvhNode(4u * word + 3u);
            vec2 first = rsBvhBox(ray, uintBitsToFloat(a.xyz), uintBitsToFloat(b.xyz), tmax);
            vec2 second = rsBvhBox(ray, uintBitsToFloat(c.xyz), uintBitsToFloat(d.xyz), tmax);
            bool hit0 = first.x <= first.y, hit1 = second.x <= second.y;
            if (hit0 || hit1) {
                bool takeSecond = hit1 && (!hit0 || second.x < first.x);
                trail = trail << 1u | uint(hit0 && hit1);
                entry = 2u * word + uint(takeSecond);
                word = takeSecond ? c.w : a.w;
                continue;
            }
        } else if (word == RS_BVH_EMPTY) {
        } else if ((word & RS_BVH_INSTANCE) != 0u) {
            uint i = 4u * (word & RS_BVH_INDEX);
            vec4 x = uintBitsToFloat(rsLoadBvhInstance(i)), y = uintBitsToFloat(rsLoadBvhInstance(i + 1u));
            vec4 z = uintBitsToFloat(rsLoadBvhInstance(i + 2u));
            uvec4 rest = rsLoadBvhInstance(i + 3u);
            vec4 o = vec4(origin, 1.0);
            ray = rsBvhRay(vec3(dot(x, o), dot(y, o), dot(z, o)),
                           vec3(dot(x.xyz, direction), dot(y.xyz, direction), dot(z.xyz, direction)));
            record = rest.y;
            inside = true;
            outerEntry = entry;
            outerTrail = trail;
            trail = 0u;
            word = rest.x;
            continue;
        } else {
            uint i = word & RS_BVH_INDEX, last = i + (word >> RS_BVH_COUNT_SHIFT & 3u);
            for (; i <= last; ++i) {
                uvec4 a = rsLoadBvhCorner(0u, i), b = rsLoadBvhCorner(1u, i), c = rsLoadBvhCorner(2u, i);
                float t;
                vec2 barycentrics;
                if (!rsBvhTriangle(ray, uintBitsToFloat(a.xyz), uintBitsToFloat(b.xyz), uintBitsToFloat(c.xyz), tmax, t, barycentrics))
                    continue;
                RsHit candidate = RsHit(t, record + (b.w & ~RS_BVH_NOT_OPAQUE), a.w, barycentrics);
                if ((b.w & RS_BVH_NOT_OPAQUE) != 0u && !rsBridgeOpaque(candidate)) continue;
                hit = candidate;
                tmax = t;
                if (any) return hit;
            }
        }
        // On to what waits: in this tree, or behind the instance in the outer one.
        if (trail == 0u && inside) {
            inside = false;
            entry = outerEntry;
            trail = outerTrail;
            ray = rsBvhRay(origin, direction);
        }
        if (trail == 0u) return hit;
        while ((trail & 1u) == 0u) {
            entry = rsLoadBvhLink(4u * (entry >> 1u) + 1u);   // its node's parent
            trail >>= 1u;
        }
        trail ^= 1u;
        entry ^= 1u;
        word = rsLoadBvhLink(2u * entry);
    }
}

#endif
