#pragma once

#include <cstdint>
#include <cstring>
#include <type_traits>

#include <vulkan/vulkan_core.h>

namespace restir {

template <class T>
concept MatrixBytes = sizeof(T) == 64 && std::is_trivially_copyable_v<T>;

// Column-major, vectors are columns. Takes any 64-byte matrix type, glm::mat4 among them.
struct Mat4 {
    float m[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

    template <MatrixBytes M>
    static Mat4 from(const M& matrix) noexcept {
        Mat4 result;
        std::memcpy(result.m, &matrix, sizeof result.m);
        return result;
    }
};

// The SDK remembers the last recorded frame's camera, so a host gives the current one only.
struct Camera {
    Mat4 viewFromWorld;   // affine, invertible
    // Vulkan clip space without jitter: perspective (clip.w = +-view z) or orthographic (clip.w = 1, looking
    // down -z); off-centre, reversed and infinite depth are fine. Shear between x and y is not supported.
    Mat4 clipFromView;
    // In pixels, already applied to the G-buffer: clip.xy += 2 jitter / extent * clip.w.
    float jitter[2] = {0, 0};
};

// A host image as a shader sees it. The SDK never changes a layout.
struct Image {
    VkImageView view = VK_NULL_HANDLE;
    VkImageLayout layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
};

enum class NormalEncoding : uint8_t {
    Xyz,               // xyz, signed
    XyzUnorm,          // xyz, stored as 0.5 + 0.5 n
    Octahedral,        // xy, signed: n / (|x| + |y| + |z|), lower half folded over the diagonals
    OctahedralUnorm,   // the same, stored as 0.5 + 0.5 e
};

enum class DepthKind : uint8_t {
    Device,   // what the rasteriser wrote, as clipFromView maps it
    Linear,   // distance along the view axis, positive in front of the camera
};

// The standard G-buffer: one sample per pixel, pixel centres at + 0.5, row 0 on top. Fetched without
// filtering in COMPUTE_SHADER. A host that stores something else overrides rsBridgeSurface(); with
// ContextDesc::bridgeSetLayout no image is required.
struct GBuffer {
    Image depth = {};             // required; x
    Image normal = {};            // required; world space shading normal, in `normals` encoding
    Image geometricNormal = {};   // optional, same encoding; absent: the shading normal
    Image baseColor = {};         // required; rgb in [0, 1], linear once fetched
    // Optional; x perceptual roughness, y metalness, z specular factor, all [0, 1]. Absent: 1, 0, 1.
    Image material = {};
    // Optional; xy times motionScale = previous minus current position in pixels of this
    // frame's extent, y down, without jitter.
    // Absent: derived from the cameras, right for static geometry.
    Image motion = {};
    Image emission = {};   // optional; emitted radiance towards the camera, below 65,408
    NormalEncoding normals = NormalEncoding::Octahedral;
    DepthKind depthKind = DepthKind::Device;
    float emptyDepth = 1.0f;   // the depth value that means "no surface here"; 0 for reversed depth
    float motionScale[2] = {1, 1};
    // Top left pixel of this view inside the images; they hold at least origin + FrameInput::extent.
    VkOffset2D origin = {0, 0};
};

// Where results go: storage images in VK_IMAGE_LAYOUT_GENERAL, written without format.
struct Output {
    // Emission plus reflected light, times exposure; w = 1. With indirect light a channel may be below 0 by
    // what its random rounding and the unbiased split of glossy paths take: clamp after averaging, not
    // before.
    VkImageView radiance = VK_NULL_HANDLE;
    // Optional, for denoisers: reflected direct light in two lobes, each over a factor of its surface, times
    // exposure; w the distance of the lights in metres, the mean weighted by what each contributes to the
    // luminance of rgb. Lights at infinity count as 65,504 m, w is 0 where rgb is. With the standard
    // materials, in exact arithmetic,
    //     radiance = exposure * emission + diffuse * (1 - metalness) * baseColor
    //                + specular * max(mix(0.04 * specularFactor, baseColor, metalness), 0.01)
    // without indirect light. Where (1 - metalness) * baseColor is black nothing is reflected diffusely, and
    // diffuse is 0. A host's own BSDF decides by rsBridgeLobes; without, all of it is in diffuse, with
    // factor 1.
    VkImageView diffuse = VK_NULL_HANDLE;
    VkImageView specular = VK_NULL_HANDLE;
    // Optional, for denoisers: indirect light in the same two lobes over the same factors; w the distance of
    // a path's second vertex from the surface, 0 where there is none. `radiance` holds both kinds of light:
    // add the sums of all four. A channel may be below 0, as in `radiance`. They need a GiSettings::mode
    // other than Off.
    VkImageView indirectDiffuse = VK_NULL_HANDLE;
    VkImageView indirectSpecular = VK_NULL_HANDLE;
    // Optional, for denoisers; one more pass, and a ray a pixel unless VisibilityReuse::None. x: confidence M
    // after temporal reuse, in pixel-frames: 1 without history, at most maxHistory + 1. y in [0, 1]: how much
    // of the pixel's light changed since the last frame, z / w with z = int |now - then| and w = int max(now,
    // then) in luminance times exposure, from one sample of each: noisy, so filter z and w over pixels where
    // two channels more can be had. 0 in a static scene, 1 where the last frame is not known, blind to light
    // that a blocker sets free. Needs DirectMode::Restir.
    VkImageView gradient = VK_NULL_HANDLE;
    VkImageView debug = VK_NULL_HANDLE;   // required with Settings::debugView, else left alone
    VkOffset2D origin = {0, 0};           // of the view's rectangle inside them
};

struct PassTiming {
    const char* name = "";   // as in debug labels
    double milliseconds = 0;
};

// Stages and access of the SDK at its edges, for the host's barriers.
struct Scope {
    VkPipelineStageFlags2 stages = 0;
    VkAccessFlags2 access = 0;
};

}   // namespace restir
