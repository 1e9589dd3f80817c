#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/bindings.glsl"
#include "passes/output.glsl"

void main() {
    uvec2 pixel = rsPixel();
    if (rsInside(pixel)) rsWriteOutputs(pixel, rsNoLight());
}
