#version 460
#extension GL_GOOGLE_include_directive : require
#define RS_PASS_SURFACE
#include "passes/bindings.glsl"

void main() {
    if (!rsInside()) return;
    uvec2 pixel = gl_GlobalInvocationID.xy;
    RsSurfaceInput host = rsBridgeSurface(pixel);
    if (host.surface.valid) {
        host.surface.position = rsPositionFromDepth(rsFrame.view, rsFrame.extent, vec2(pixel) + 0.5, host.surface.depth);
        host.surface.view = rsTowardsEye(rsFrame.view, host.surface.position);
        rsFaceViewer(host.surface);
    }
    RsPackedSurface packed = rsPackSurface(host.surface);
    uint i = rsIndex(pixel);
    rsSurfaces[i] = packed.geometry;
    rsSurfacesMore[i] = packed.material;
    rsSurfacesFrame[i] = uvec2(packHalf2x16(host.motion), host.surface.valid ? rsPackRadiance(host.emission) : 0u);
}
