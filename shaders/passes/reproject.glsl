// Where this pixel's surface was in the previous frame, in its pixels with its jitter: by the host's motion, else by the
// cameras.
vec2 rsPreviousPixel(uvec2 pixel, RsSurface s) {
    if ((rsFrame.flags & RS_FRAME_MOTION) == 0u) return rsPixelOf(rsFrame.previousView, rsFrame.previousExtent, s.position);
    vec2 motion = unpackHalf2x16(rsSurfacesFrame[rsIndex(pixel)].x);
    vec2 at = (vec2(pixel) + 0.5 + motion) / vec2(rsFrame.extent) - 0.5 * rsFrame.view.jitter;
    return (at + 0.5 * rsFrame.previousView.jitter) * vec2(rsFrame.previousExtent);
}
