// Per-frame constants and the bindings of set 0.
#ifndef RESTIR_SHARED_FRAME_H
#define RESTIR_SHARED_FRAME_H
#include "restir/shared/di.h"
#include "restir/shared/types.h"
RS_SHARED_BEGIN

// A camera, split so that a position is rebuilt from pixel and linear depth without inverting a product.
struct RsView {
    vec4 viewFromWorld[3];   // rows of the affine transform
    vec3 axisX;              // columns of its inverse: world-space images of the view axes
    vec3 axisY;
    vec3 axisZ;
    vec3 eye;
    vec4 projection;     // clip.x = x * depthOrOne^-1 ...: P00, P11, and the offsets P20 * zSign, P21 * zSign
    vec2 translation;    // P30, P31
    vec4 depthTerms;     // P22, P32, P23, P33: device depth to view z
    float zSign;         // view z = zSign * linear depth
    float perspective;   // 1: w = linear depth; 0: orthographic, w = 1
    vec2 jitter;         // NDC, added to every projected position
};

struct RsFrame {
    RsView view;
    RsView previousView;
    uvec2 extent;
    uvec2 previousExtent;
    uvec2 gbufferOrigin;   // of the view's rectangle inside the host's images
    uvec2 outputOrigin;
    uint seed;         // hash of FrameInput::frameIndex and seed
    uint lightCount;   // columns of the alias table; 0: nothing to draw
    uint previousLightCount;
    uint flags;                // RS_FRAME_*
    float emptyDepth;          // G-buffer depth that means "nothing here"
    float exposure;            // multiplies outputs only
    vec2 motionScale;          // host motion to pixels, previous minus current
    uint normalEncoding;       // RS_NORMAL_*
    uint rayLogCapacity;       // rays
    uint debugView;            // RS_DEBUG_*
    uvec2 environmentExtent;   // texels of the importance table
    uvec4 infiniteLights;      // ids, those there are in front; else RS_NO_LIGHT
    RsDiConstants di;
    RsDiConstants gi;   // of indirect light
    uint giBounces;     // scattering events of a path at most
    uint giScratch;     // reservoir buffer of direct light that is free meanwhile: what lit pixels reflect, for gi.fill
    float giStale;      // [0, 1] what last frame's paths behind a second vertex count for
    uint bvhRoot;       // RayBackend::Software: words of this frame's tree and the last one's
    uint bvhPreviousRoot;
};

// Push constants of every pass.
struct RsPass {
    uint source;   // reservoir buffer the pass reads
    uint target;   // and the one it writes
    uint index;    // of this pass among its like: decorrelates random numbers
    uint shades;   // 1: writes the outputs
};

// Sums over a frame, for reports and tests; written only with RS_FRAME_COUNT.
struct RsCounters {
    uint rays;
    uint rejectedWeights;   // weights that were not finite or negative, stored as 0 instead
    uint loggedRays;
    uint spare;
};

// One ray of the log: a segment, and what it asks.
struct RsLoggedRay {
    vec4 originTmax;         // xyz, tmax
    vec4 directionClosest;   // xyz, 1: closest hit, 0: any hit
};

RS_SHARED_END

#define RS_FRAME_HISTORY 1u   // the previous frame is known
#define RS_FRAME_MOTION 2u    // motion image is bound
#define RS_FRAME_GEOMETRIC_NORMAL 4u
#define RS_FRAME_MATERIAL 8u
#define RS_FRAME_EMISSION 16u
#define RS_FRAME_LINEAR_DEPTH 32u
#define RS_FRAME_COUNT 64u
#define RS_FRAME_DIFFUSE 128u   // output image is bound
#define RS_FRAME_SPECULAR 256u
#define RS_FRAME_MOVED 4096u          // geometry, since the previous frame, whose structure is bound
#define RS_FRAME_INDIRECT_DIFFUSE 1024u   // output image is bound
#define RS_FRAME_INDIRECT_SPECULAR 2048u
#define RS_FRAME_OWN_PATH 8192u   // GiSettings::ownPath
#define RS_FRAME_INDIRECT 512u   // rsSurfacesFrame keeps emission and indirect light, rounded at random

#define RS_NORMAL_XYZ 0u                // xyz, signed
#define RS_NORMAL_XYZ_UNORM 1u          // xyz, 0.5 + 0.5 n
#define RS_NORMAL_OCTAHEDRAL 2u         // xy, signed
#define RS_NORMAL_OCTAHEDRAL_UNORM 3u   // xy, 0.5 + 0.5 e

// Set 0 belongs to the SDK, set 1 to the scene: the standard one, or the host's bridge.
#define RS_SET 0
#define RS_SET_SCENE 1

#define RS_BIND_FRAME 0
#define RS_BIND_SURFACES 1        // uvec4: depth, normal, geometric normal, base colour
#define RS_BIND_SURFACES_MORE 2   // uvec2: roughness/metalness/specular/flags, material id
#define RS_BIND_SURFACES_FRAME \
    3   // uvec2: motion, emission (with RS_FRAME_INDIRECT plus indirect light); this frame only
#define RS_BIND_PREVIOUS_SURFACES 4
#define RS_BIND_PREVIOUS_MORE 5
#define RS_BIND_RESERVOIRS 6   // [2]
#define RS_BIND_LIGHTS 7
#define RS_BIND_PREVIOUS_LIGHTS 8
#define RS_BIND_ALIAS 9
#define RS_BIND_TLAS 10   // RayBackend::RayQuery and Pipeline, as the next
#define RS_BIND_PREVIOUS_TLAS 11   // the current one where the host gives none
#define RS_BIND_COUNTERS 12
#define RS_BIND_RAY_LOG 13
#define RS_BIND_NOTES 14           // uint: targets of partners' samples, two in a word
#define RS_BIND_ENVIRONMENT 15     // RsEnvironmentTexel: the importance table
#define RS_BIND_GI_RESERVOIRS 16   // [2 RS_GI_STREAMS] uvec4: A, then B
#define RS_BIND_DEPTH 17
#define RS_BIND_NORMAL 18
#define RS_BIND_GEOMETRIC_NORMAL 19
#define RS_BIND_BASE_COLOR 20
#define RS_BIND_MATERIAL 21
#define RS_BIND_MOTION 22
#define RS_BIND_EMISSION 23
#define RS_BIND_RADIANCE 24
#define RS_BIND_DEBUG 25   // from RADIANCE on: storage images
#define RS_BIND_DIFFUSE 26
#define RS_BIND_SPECULAR 27
#define RS_BIND_GRADIENT 28
#define RS_BIND_INDIRECT_DIFFUSE 29
#define RS_BIND_INDIRECT_SPECULAR 30
#define RS_BIND_LIGHT_TREE 31   // uvec4: restir/lights/tree.glsl
#define RS_BIND_BVH_NODES 32   // RayBackend::Software: RsBvhNode, in vectors of 16 bytes
#define RS_BIND_BVH_CORNERS 33   // [3] RsBvhCorner
#define RS_BIND_BVH_INSTANCES 34   // RsBvhInstance
#define RS_BIND_COUNT 35

#define RS_SCENE_BIND_INSTANCES 0
#define RS_SCENE_BIND_MATERIALS 1
#define RS_SCENE_BIND_TEXTURES 2

#endif
