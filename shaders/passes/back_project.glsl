// Where a pixel's surface was in the last frame: by the host's motion, else by the cameras.
#include "restir/di/history.glsl"

RsBackProjection rsBackProject(uvec2 pixel, RsSurface s) {
    RsBackProjection back = RsBackProjection(rsPixelOf(rsFrame.previousView, rsFrame.previousExtent, s.position),
                                             rsDepthOf(rsFrame.previousView, s.position), rsFrame.previousExtent);
    if ((rsFrame.flags & RS_FRAME_MOTION) != 0u) {
        vec2 motion = unpackHalf2x16(rsSurfacesFrame[rsIndex(pixel)].x);
        vec2 at = (vec2(pixel) + 0.5 + motion) / vec2(rsFrame.extent) - 0.5 * rsFrame.view.jitter;
        back.pixel = (at + 0.5 * rsFrame.previousView.jitter) * vec2(rsFrame.previousExtent);
    }
    return back;
}
