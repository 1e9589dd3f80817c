// Renders sequences of frames into a float picture, two in flight.
#pragma once

#include <functional>
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
    bool accumulate = false;   // the mean of all frames, each jittered over the pixel; else the last frame
    float orbitDegrees = 0;    // the camera's turn about its target from frame to frame
    // Gets each frame's picture, in order: four floats a pixel. May be empty.
    std::function<void(uint32_t index, std::span<const float> rgba)> eachFrame = {};
};

struct Frame {
    uint32_t index = 0;
    uint32_t slot = 0;
    bool last = false;
    uint32_t seed = 0;           // the sequence's
    CameraPose pose, previous;   // of the first frame: the same
    glm::vec2 jitter{0};         // pixels
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

    FloatImage run(const Sequence& sequence, const FrameCallbacks& callbacks);

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
