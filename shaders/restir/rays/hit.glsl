// What a ray backend answers. Backends implement the two functions; shading stays with the caller.
#ifndef RESTIR_RAYS_HIT_GLSL
#define RESTIR_RAYS_HIT_GLSL

struct RsHit {
    float t;             // in units of the direction's length; < 0: nothing hit
    uint instance;       // instanceCustomIndex + geometryIndex
    uint primitive;
    vec2 barycentrics;   // of vertices 1 and 2
};

// Anything between origin and origin + tmax * direction? `previous`: in last frame's structure.
bool rsOccluded(vec3 origin, vec3 direction, float tmax, bool previous);
RsHit rsClosestHit(vec3 origin, vec3 direction, float tmax);

// Whether a candidate hit on geometry without the opaque flag stops a ray (alpha-tested shadows).
bool rsBridgeOpaque(RsHit hit);
// Hook of the passes: counts and logs.
void rsOnRay(vec3 origin, vec3 direction, float tmax, bool closest);

#endif
