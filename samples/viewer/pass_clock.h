// GPU times of the host's own passes, to be seen beside the library's.
#pragma once

#include <vector>

#include <restir/frame.h>

#include "common/device.h"

namespace viewer {

class PassClock {
public:
    explicit PassClock(const samples::Device& device);
    ~PassClock();
    PassClock(const PassClock&) = delete;
    PassClock& operator=(const PassClock&) = delete;

    // Once a frame, outside any render pass.
    void begin(VkCommandBuffer cmd, uint32_t slot);
    // Everything recorded since begin() or the last mark() is of `name`, static text; null: of nobody here.
    void mark(VkCommandBuffer cmd, const char* name);
    // Of the slot's last frame, which the GPU is done with. Empty where the queue has no timestamps.
    std::vector<restir::PassTiming> timings(uint32_t slot) const;

private:
    static constexpr uint32_t kMost = 8;   // marks in a frame

    void stamp(VkCommandBuffer cmd);

    const samples::Device& device_;
    VkQueryPool pool_ = VK_NULL_HANDLE;   // null: no timestamps
    uint32_t slot_ = 0;
    std::vector<const char*> names_[samples::FrameSlots::kCount];
};

}   // namespace viewer
