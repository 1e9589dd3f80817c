// Renders sequences of frames into a float picture, two in flight.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "common/camera.h"
#include "common/gpu_memory.h"
#include "common/image_io.h"

namespace samples {

struct Sequence {
    View view;   // of the last frame
    uint32_t frames = 1;
    uint32_t seed = 0;         // sequences with different seeds are independent
    bool accumulate = false;   // the mean of all frames but the first `skip`; else the last frame
    uint32_t skip = 0;
    std::optional<bool> jitter = {};   // over the pixel, from frame to frame; unset: if accumulated
    float orbitDegrees = 0;            // the camera's turn about its target from frame to frame
    Motion motion = {};                // of the scene
    bool denoise = false;       // pictures of the SDK
    bool previousTlas = true;   // tell the SDK last frame's acceleration structure; off: a host that has none
    // Gets each frame's picture, in order: four floats a pixel. May be empty.
    std::function<void(uint32_t index, std::span<const float> rgba)> eachFrame = {};

    bool jitters() const { return jitter.value_or(accumulate); }
};

struct Frame {
    uint32_t index = 0;
    uint32_t slot = 0;
    bool last = false;
    bool cut = false;                   // nothing of the frame before is seen again
    uint32_t seed = 0;                  // the sequence's
    float time = 0, previousTime = 0;   // of the last frame: 0; of the first: the same
    CameraPose pose, previous;          // likewise
    glm::vec2 jitter{0};                // pixels
};

struct FrameCallbacks {
    // Writes FrameLoop::target(), in VK_IMAGE_LAYOUT_GENERAL, and leaves its writes in `written`.
    std::function<void(VkCommandBuffer, const Frame&)> record;
    // The GPU is done with the frame; `target` is what it wrote, four channels a pixel.
    std::function<void(const Frame&, std::span<const float> target)> finished;
    std::function<void(uint32_t done, uint32_t all)> progress;   // may be empty
    restir::Scope written;
};

class FrameLoop {
public:
    FrameLoop(const Device& device, VkExtent2D extent);

    VkImageView target() const { return target_.view(); }
    VkExtent2D extent() const { return extent_; }

    // From frame `first` on: an estimator without history need not render what is not counted.
    FloatImage run(const Sequence& sequence, const FrameCallbacks& callbacks, uint32_t first = 0);

private:
    Frame describe(const Sequence& sequence, uint32_t index) const;
    void submit(const Frame& frame, const FrameCallbacks& callbacks);
    void finish(const Sequence& sequence, const Frame& frame, const FrameCallbacks& callbacks);

    VkExtent2D extent_;
    GpuImage target_;
    Buffer readback_[FrameSlots::kCount];
    FrameSlots slots_;
    std::vector<double> sum_;
    uint32_t summed_ = 0;   // frames
};

}   // namespace samples
