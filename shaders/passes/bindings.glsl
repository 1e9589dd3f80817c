// Set 0, and the loads and stores that the library asks its includer for. Every pass starts with this file.
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require
#extension GL_EXT_nonuniform_qualifier : require
#extension GL_EXT_samplerless_texture_functions : require
#include "restir/shared/frame.h"
#include "restir/shared/lights.h"
#include "restir/shared/scene.h"

#ifdef RS_RAY_STAGE   // of RayBackend::Pipeline: a pixel is a launch
#extension GL_EXT_ray_tracing : require
#define RS_INVOCATION gl_LaunchIDEXT
#else
layout(local_size_x = 8, local_size_y = 8) in;
#define RS_INVOCATION gl_GlobalInvocationID
#endif
layout(push_constant, scalar) uniform RsPassBlock { RsPass rsPass; };
layout(set = RS_SET, binding = RS_BIND_FRAME, scalar) uniform RsFrameBlock { RsFrame rsFrame; };

layout(set = RS_SET, binding = RS_BIND_SURFACES, scalar) buffer RsSurfaces { uvec4 rsSurfaces[]; };
layout(set = RS_SET, binding = RS_BIND_SURFACES_MORE, scalar) buffer RsSurfacesMore { uvec2 rsSurfacesMore[]; };
layout(set = RS_SET, binding = RS_BIND_SURFACES_FRAME, scalar) buffer RsSurfacesFrame { uvec2 rsSurfacesFrame[]; };
layout(set = RS_SET, binding = RS_BIND_PREVIOUS_SURFACES, scalar) readonly buffer RsOldSurfaces { uvec4 rsPreviousSurfaces[]; };
layout(set = RS_SET, binding = RS_BIND_PREVIOUS_MORE, scalar) readonly buffer RsOldMore { uvec2 rsPreviousMore[]; };
layout(set = RS_SET, binding = RS_BIND_RESERVOIRS, scalar) buffer RsReservoirs { RsReservoir at[]; } rsReservoirs[2];
layout(set = RS_SET, binding = RS_BIND_LIGHTS, scalar) readonly buffer RsLights { uvec4 rsLights[]; };
layout(set = RS_SET, binding = RS_BIND_PREVIOUS_LIGHTS, scalar) readonly buffer RsOldLights { uvec4 rsPreviousLights[]; };
layout(set = RS_SET, binding = RS_BIND_ALIAS, scalar) readonly buffer RsAlias { RsAliasEntry rsAlias[]; };
layout(set = RS_SET, binding = RS_BIND_LIGHT_TREE, scalar) readonly buffer RsLightTree { uvec4 rsLightTree[]; };
layout(set = RS_SET, binding = RS_BIND_COUNTERS, scalar) buffer RsCounterBlock { RsCounters rsCounters; };
layout(set = RS_SET, binding = RS_BIND_RAY_LOG, scalar) buffer RsRayLog { RsLoggedRay rsRayLog[]; };
layout(set = RS_SET, binding = RS_BIND_ENVIRONMENT, scalar) readonly buffer RsEnvironmentTable { RsEnvironmentTexel at[]; } rsEnvironment;

#include "restir_bridge.glsl"
#include "restir/di/direct.glsl"
#include "restir/di/field.glsl"
#include "restir/di/reservoir.glsl"

// The pixel of this invocation.
uvec2 rsPixelOn(uint field) { return uvec2(rsFieldPixel(ivec2(RS_INVOCATION.xy), field)); }
uvec2 rsPixel() { return rsPixelOn(rsFrame.di.field); }
bool rsInside(uvec2 pixel) { return all(lessThan(pixel, rsFrame.extent)); }
uint rsIndex(uvec2 pixel) { return pixel.y * rsFrame.extent.x + pixel.x; }
uint rsPreviousIndex(uvec2 pixel) { return pixel.y * rsFrame.previousExtent.x + pixel.x; }

RsSurface rsLoadSurface(uvec2 pixel) {
    uint i = rsIndex(pixel);
    return rsUnpackSurface(RsPackedSurface(rsSurfaces[i], rsSurfacesMore[i]), rsFrame.view, rsFrame.extent, pixel);
}
RsSurface rsLoadPreviousSurface(uvec2 pixel) {
    uint i = rsPreviousIndex(pixel);
    return rsUnpackSurface(RsPackedSurface(rsPreviousSurfaces[i], rsPreviousMore[i]), rsFrame.previousView,
                           rsFrame.previousExtent, pixel);
}

RsReservoir rsLoadSource(uvec2 pixel) { return rsReservoirs[rsPass.source].at[rsIndex(pixel)]; }
// The source buffer as the previous frame left it.
RsReservoir rsLoadHistory(uvec2 pixel) {
    RsReservoir r = rsReservoirs[rsPass.source].at[rsPreviousIndex(pixel)];
    r.confidence = min(rsConfidence(r), rsFrame.di.maxHistory) | (min(rsAge(r) + 1u, 0xffffu) << 16u);
    return r;
}

RsPackedLight rsUnpackLight(uvec4 a, uvec4 b, uvec4 c, uvec4 d, uvec4 e) {
    RsPackedLight light;
    light.position = uintBitsToFloat(a.xyz);
    light.kindAndTexture = a.w;
    light.edge1 = uintBitsToFloat(b.xyz);
    light.edge2 = uintBitsToFloat(uvec3(b.w, c.xy));
    light.emission = uintBitsToFloat(uvec3(c.zw, d.x));
    light.selection = uintBitsToFloat(d.y);
    light.uv0 = uintBitsToFloat(d.zw);
    light.uv1 = uintBitsToFloat(e.xy);
    light.uv2 = uintBitsToFloat(e.zw);
    return light;
}
RsPackedLight rsLoadLight(uint id) {
    if (id >= rsFrame.lightCount) return rsUnpackLight(uvec4(0u), uvec4(0u), uvec4(0u), uvec4(0u), uvec4(0u));
    uint i = id * RS_LIGHT_STRIDE;
    uvec4 first = rsLights[i];
    return rsUnpackLight(first, rsLights[i + 1u], rsLights[i + 2u], rsLights[i + 3u],
                         rsIsTextured(first.w) ? rsLights[i + 4u] : uvec4(0u));
}
RsPackedLight rsLoadPreviousLight(uint id) {
    if (id >= rsFrame.previousLightCount) return rsUnpackLight(uvec4(0u), uvec4(0u), uvec4(0u), uvec4(0u), uvec4(0u));
    uint i = id * RS_LIGHT_STRIDE;
    uvec4 first = rsPreviousLights[i];
    return rsUnpackLight(first, rsPreviousLights[i + 1u], rsPreviousLights[i + 2u], rsPreviousLights[i + 3u],
                         rsIsTextured(first.w) ? rsPreviousLights[i + 4u] : uvec4(0u));
}
RsAliasEntry rsLoadAlias(uint column) { return rsAlias[column]; }
uvec4 rsLoadTreeNode(uint slot) { return rsLightTree[slot]; }
uint rsLoadTreeWord(uint index) { return rsLightTree[index / 4u][index % 4u]; }
uint rsInfiniteLight(uint i) { return rsFrame.infiniteLights[i]; }
uvec2 rsEnvironmentExtent() { return rsFrame.environmentExtent; }
RsEnvironmentTexel rsLoadEnvironment(uint index) { return rsEnvironment.at[index]; }

void rsOnRay(vec3 origin, vec3 direction, float tmax, bool closest) {
    if ((rsFrame.flags & RS_FRAME_COUNT) == 0u) return;
    atomicAdd(rsCounters.rays, 1u);
    if (rsFrame.rayLogCapacity == 0u) return;
    uint slot = atomicAdd(rsCounters.loggedRays, 1u);
    if (slot < rsFrame.rayLogCapacity)
        rsRayLog[slot] = RsLoggedRay(vec4(origin, tmax), vec4(direction, closest ? 1.0 : 0.0));
}
#ifndef RS_PASS_INDIRECT
bool rsWantsLobes() {
    bool asked = (rsFrame.flags & (RS_FRAME_DIFFUSE | RS_FRAME_SPECULAR)) != 0u || rsFrame.di.field != RS_FIELD_ALL;
    return rsPass.shades != 0u && asked;
}
#else
bool rsWantsLobes() {
    bool asked = (rsFrame.flags & (RS_FRAME_INDIRECT_DIFFUSE | RS_FRAME_INDIRECT_SPECULAR)) != 0u || rsFrame.gi.field != RS_FIELD_ALL;
#ifdef RS_PASS_OWN   // shades its part, whatever comes after it
    return asked;
#else
    return rsPass.shades != 0u && asked;
#endif
}
#endif
// What a pixel shines of itself: its emission, and indirect light as far as it has been added.
vec3 rsLoadOwnLight(uvec2 pixel) { return rsUnpackRadiance(rsSurfacesFrame[rsIndex(pixel)].y); }
uint rsPackOwnLight(vec3 light, inout RsRandom random) {
    if ((rsFrame.flags & RS_FRAME_INDIRECT) == 0u) return rsPackRadiance(light);
    return rsPackRadiance(light, vec3(rsNext2(random), rsNext(random)));
}
void rsOnRejectedWeight() {
    if ((rsFrame.flags & RS_FRAME_COUNT) != 0u) atomicAdd(rsCounters.rejectedWeights, 1u);
}

#ifdef RS_PASS_RAYS
#include "restir_rays.glsl"
#endif
