// From a frame's light to what the window shows, and what is learnt of it on the way.
#pragma once

#include <optional>

#include "common/scene_pass.h"

namespace viewer {

struct DisplaySettings {
    float exposure = 1;
    float line = 1;                 // the reference is shown to the right of it; in [0, 1] of the width
    bool debug = false;             // show the debug view instead of light
    uint32_t referenceFrames = 0;   // that went into its mean, this one among them; 0: no reference
};

// Of one frame.
struct Findings {
    samples::FloatImage thumbnail;   // radiance, one pixel for 8x8
    std::optional<double> error;     // relative, mean of squares, against the reference so far
};

class Display {
public:
    struct Inputs {
        VkImageView radiance, debug, paths;   // in VK_IMAGE_LAYOUT_GENERAL, paths those of ReferencePass
    };
    Display(const samples::Device& device, const samples::GpuScene& scene, VkExtent2D extent,
            const Inputs& inputs);

    // Behind everything that writes the inputs, in a compute shader; before a copy from image().
    void record(VkCommandBuffer cmd, uint32_t slot, const DisplaySettings& settings);
    const samples::GpuImage& image() const { return shown_; }   // in TRANSFER_SRC_OPTIMAL, sRGB in eight bits
    // Of the slot's last frame, which the GPU is done with; nothing where that was before this was made.
    std::optional<Findings> collect(uint32_t slot);

private:
    VkExtent2D extent_, tiles_;
    samples::GpuImage mean_, shown_;
    samples::Buffer findings_;
    samples::ScenePass pass_;
    double referenceMean_ = 0;
    struct Recorded {
        bool frame = false, reference = false;
    };
    Recorded recorded_[samples::FrameSlots::kCount];
};

}   // namespace viewer
