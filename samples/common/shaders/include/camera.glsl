// Pinhole cameras; CameraPose in camera.h.
#ifndef SAMPLES_CAMERA_GLSL
#define SAMPLES_CAMERA_GLSL

struct CameraPose {
    vec3 eye;
    vec3 right;     // length tan(half horizontal field of view)
    vec3 up;        // length tan(half vertical field of view)
    vec3 forward;   // unit
};

// The ray through a position in pixels, row 0 on top; not normalised: one unit along `forward`.
vec3 cameraDirection(CameraPose camera, vec2 pixel, vec2 extent) {
    vec2 ndc = 2.0 * pixel / extent - 1.0;
    return camera.forward + ndc.x * camera.right - ndc.y * camera.up;
}

// Where a point appears, in pixels.
vec2 cameraPixel(CameraPose camera, vec3 point, vec2 extent) {
    vec3 d = point - camera.eye;
    float depth = max(dot(d, camera.forward), 1e-6 * length(d));
    vec2 ndc = vec2(dot(d, camera.right) / dot(camera.right, camera.right),
                    -dot(d, camera.up) / dot(camera.up, camera.up)) / depth;
    return (0.5 * ndc + 0.5) * extent;
}

#endif
