#version 460
#extension GL_GOOGLE_include_directive : require
#define RS_PASS_SURFACE
#include "passes/bindings.glsl"

bool isUnit(vec3 n) { return abs(dot(n, n) - 1.0) < 0.01; }   // false for NaN

void main() {
    uvec2 pixel = rsPixelOn(RS_FIELD_ALL);
    if (!rsInside(pixel)) return;
    RsSurfaceInput host = rsBridgeSurface(pixel);
    host.surface.valid = host.surface.valid && host.surface.depth > 0.0 && host.surface.depth < RS_FAR &&
                         isUnit(host.surface.normal) && isUnit(host.surface.geometricNormal);
    if (host.surface.valid) {
        host.surface.position = rsPositionFromDepth(rsFrame.view, rsFrame.extent, vec2(pixel) + 0.5, host.surface.depth);
        host.surface.view = rsTowardsEye(rsFrame.view, host.surface.position);
        rsFaceViewer(host.surface);
    }
    RsPackedSurface packed = rsPackSurface(host.surface);
    uint i = rsIndex(pixel);
    rsSurfaces[i] = packed.geometry;
    rsSurfacesMore[i] = packed.material;
    RsRandom random = rsRandom(pixel, rsFrame.seed, RS_STAGE_OWN_LIGHT);
    uint light = host.surface.valid ? rsPackOwnLight(host.emission, random) : 0u;
    rsSurfacesFrame[i] = uvec2(packHalf2x16(host.motion), light);
}
