// The environment map as a table to draw its texels from.
#pragma once

#include <vector>

#include <device/buffers.h>
#include <restir/lights.h>
#include <restir/shared/lights.h>

namespace restir {

// Texels by the luminance that a linear filter makes of them, times their solid angle.
struct EnvironmentImportance {
    std::vector<gpu::RsEnvironmentTexel> texels;   // row by row; probabilities 0 where the map is black
    double luminance = 0;                          // integral over the sphere
};
EnvironmentImportance weighEnvironment(const EnvironmentMap& map);

// The table on the device. One upload is in flight at a time.
class EnvironmentTable {
public:
    static Result<EnvironmentTable> create(const Device& device, uint32_t maxTexels) noexcept;
    static VkDeviceSize memoryNeeded(const Device& device, uint32_t maxTexels) noexcept;

    // Names the field if one is bad, and keeps the last map.
    Status upload(const MessageSink& sink, const EnvironmentMap& map) noexcept;
    // The copy of a new map, with its barriers.
    void record(const Device& device, VkCommandBuffer cmd) noexcept;

    VkBuffer buffer() const noexcept { return buffers_.buffer(0); }
    gpu::uvec2 extent() const noexcept { return extent_; }
    double luminance() const noexcept {
        return luminance_;
    }   // as in EnvironmentImportance; negative: no map yet

private:
    Buffers buffers_;
    uint32_t maxTexels_ = 0;
    gpu::uvec2 extent_{};
    double luminance_ = -1;
    bool pending_ = false;   // the staging buffer has not been recorded yet
};

}   // namespace restir
