// GPU time of passes, by frame slot.
#pragma once

#include <vector>

#include <device/device.h>
#include <restir/frame.h>

namespace restir {

class Stopwatch {
public:
    Stopwatch() = default;
    ~Stopwatch();
    Stopwatch(const Stopwatch&) = delete;
    Stopwatch& operator=(const Stopwatch&) = delete;

    // For at most `passes` in each slot. Does nothing on a queue without timestamps. `device` outlives this.
    VkResult create(const Device& device, uint32_t slots, uint32_t passes) noexcept;

    void reset(uint32_t slot) noexcept;   // of the passes that follow
    // Around a pass; `name` is static text.
    void start(VkCommandBuffer cmd, uint32_t slot, const char* name, VkPipelineStageFlags2 stage = kCompute) noexcept;
    void stop(VkCommandBuffer cmd, uint32_t slot, VkPipelineStageFlags2 stage = kCompute) noexcept;

    // Of what was recorded since the slot's last reset(), once the GPU is done with it. Lives until the next call.
    std::span<const PassTiming> read(uint32_t slot) noexcept;

private:
    static constexpr VkPipelineStageFlags2 kCompute = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
    void stamp(VkCommandBuffer cmd, uint32_t slot, uint32_t end, VkPipelineStageFlags2 stage) noexcept;

    const Device* device_ = nullptr;
    VkQueryPool queries_ = VK_NULL_HANDLE;
    uint32_t passes_ = 0;
    std::vector<std::vector<const char*>> names_;   // by slot
    std::vector<uint64_t> stamps_;
    std::vector<PassTiming> timings_;
};

}   // namespace restir
