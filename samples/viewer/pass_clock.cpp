#include "viewer/pass_clock.h"

namespace viewer {

PassClock::PassClock(const samples::Device& device) : device_(device) {
    if (!device.hasTimestamps()) return;
    const VkQueryPoolCreateInfo info{.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO,
                                     .queryType = VK_QUERY_TYPE_TIMESTAMP,
                                     .queryCount = (kMost + 1) * samples::FrameSlots::kCount};
    samples::check(vkCreateQueryPool(device.handle(), &info, nullptr, &pool_), "vkCreateQueryPool");
}

PassClock::~PassClock() { vkDestroyQueryPool(device_.handle(), pool_, nullptr); }

void PassClock::begin(VkCommandBuffer cmd, uint32_t slot) {
    slot_ = slot;
    names_[slot].clear();
    if (pool_ == VK_NULL_HANDLE) return;
    vkCmdResetQueryPool(cmd, pool_, slot * (kMost + 1), kMost + 1);
    stamp(cmd);
}

void PassClock::stamp(VkCommandBuffer cmd) {
    const auto at = static_cast<uint32_t>(names_[slot_].size());
    vkCmdWriteTimestamp2(cmd, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, pool_, slot_ * (kMost + 1) + at);
}

void PassClock::mark(VkCommandBuffer cmd, const char* name) {
    if (pool_ == VK_NULL_HANDLE || names_[slot_].size() == kMost) return;
    names_[slot_].push_back(name);
    stamp(cmd);
}

std::vector<restir::PassTiming> PassClock::timings(uint32_t slot) const {
    const std::vector<const char*>& names = names_[slot];
    uint64_t stamps[kMost + 1] = {};
    if (names.empty() || vkGetQueryPoolResults(device_.handle(), pool_, slot * (kMost + 1),
                                               static_cast<uint32_t>(names.size()) + 1, sizeof stamps, stamps,
                                               sizeof stamps[0], VK_QUERY_RESULT_64_BIT) != VK_SUCCESS)
        return {};
    const double milliseconds = double(device_.properties().limits.timestampPeriod) * 1e-6;
    std::vector<restir::PassTiming> timings;
    for (size_t i = 0; i < names.size(); ++i)
        if (names[i])
            timings.push_back({names[i], static_cast<double>(stamps[i + 1] - stamps[i]) * milliseconds});
    return timings;
}

}   // namespace viewer
