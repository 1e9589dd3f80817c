#include <device/stopwatch.h>

namespace restir {

Stopwatch::~Stopwatch() {
    if (queries_) device_->functions.vkDestroyQueryPool(device_->info.device, queries_, device_->allocator());
}

VkResult Stopwatch::create(const Device& device, uint32_t slots, uint32_t passes) noexcept {
    device_ = &device;
    passes_ = passes;
    names_.resize(slots);
    for (auto& names : names_) names.reserve(passes);
    if (device.timestampBits == 0) return VK_SUCCESS;
    const VkQueryPoolCreateInfo info{.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO,
                                     .queryType = VK_QUERY_TYPE_TIMESTAMP,
                                     .queryCount = 2 * passes * slots};
    return orNull(device.functions.vkCreateQueryPool(device.info.device, &info, device.allocator(), &queries_), queries_);
}

void Stopwatch::reset(uint32_t slot) noexcept { names_[slot].clear(); }

void Stopwatch::start(VkCommandBuffer cmd, uint32_t slot, const char* name, VkPipelineStageFlags2 stage) noexcept {
    const auto number = uint32_t(names_[slot].size());
    names_[slot].push_back(name);
    // Its own only: passes of a frame may be in several command buffers.
    if (queries_) device_->functions.vkCmdResetQueryPool(cmd, queries_, 2 * (slot * passes_ + number), 2);
    stamp(cmd, slot, 0, stage);
}

void Stopwatch::stop(VkCommandBuffer cmd, uint32_t slot, VkPipelineStageFlags2 stage) noexcept { stamp(cmd, slot, 1, stage); }

void Stopwatch::stamp(VkCommandBuffer cmd, uint32_t slot, uint32_t end, VkPipelineStageFlags2 stage) noexcept {
    const uint32_t query = 2 * (slot * passes_ + uint32_t(names_[slot].size()) - 1) + end;
    if (queries_) device_->functions.vkCmdWriteTimestamp2(cmd, stage, queries_, query);
}

std::span<const PassTiming> Stopwatch::read(uint32_t slot) noexcept {
    timings_.clear();
    if (slot >= names_.size() || !queries_ || names_[slot].empty()) return {};
    const std::vector<const char*>& names = names_[slot];
    stamps_.resize(2 * names.size());
    const VkResult vk = device_->functions.vkGetQueryPoolResults(
        device_->info.device, queries_, slot * 2 * passes_, uint32_t(stamps_.size()), stamps_.size() * sizeof(uint64_t),
        stamps_.data(), sizeof(uint64_t), VK_QUERY_RESULT_64_BIT);
    if (vk < 0) failure(device_->sink(), Status::DeviceError, "reading the timestamps of the passes failed", vk);
    if (vk != VK_SUCCESS) return {};
    const uint64_t mask = ~uint64_t(0) >> (64 - device_->timestampBits);
    for (size_t i = 0; i < names.size(); ++i) {
        const double ticks = double((stamps_[2 * i + 1] - stamps_[2 * i]) & mask);
        timings_.push_back({names[i], ticks * double(device_->limits.timestampPeriod) * 1e-6});
    }
    return timings_;
}

}   // namespace restir
