#include "common/ray_tracer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include <trace_query.spv.h>
#include <trace_software.spv.h>

namespace samples {
namespace {

constexpr uint32_t kGroupSide = 8;
constexpr VkBufferUsageFlags kUsage =
    VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;

// Constants in trace_rays.glsl, for a ray generation shader.
struct Addresses {
    VkDeviceAddress rays, hits;
    uint32_t count, unused;
};

constexpr Access kHost{VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT};

// Groups of 64 rays in a square: 65,535 are the most in a row.
VkExtent2D extentOf(uint32_t rays) {
    const uint32_t groups = (rays + kGroupSide * kGroupSide - 1) / (kGroupSide * kGroupSide);
    const auto side = static_cast<uint32_t>(std::ceil(std::sqrt(static_cast<double>(groups))));
    return {kGroupSide * side, kGroupSide * side};
}

}   // namespace

RayTracer::RayTracer(const Device& device, const GpuScene& scene, restir::RayBackend rays,
                     const restir::Bvh* bvh)
    : device_(device), scene_(scene), backend_(rays), bvh_(bvh) {}

VkPipelineStageFlags2 RayTracer::stage() const {
    return launch_ ? VK_PIPELINE_STAGE_2_RAY_TRACING_SHADER_BIT_KHR : VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
}

void RayTracer::makePass() {
    if (backend_ == restir::RayBackend::Pipeline) {
        if (!launch_) launch_ = std::make_unique<RayLaunch>(device_, scene_, sizeof(Addresses));
    } else if (bvh_) {
        const restir::BvhBuffers b = bvh_->buffers();
        const VkBuffer buffers[] = {rays_.handle(), hits_.handle(), b.nodes,    b.corners[0],
                                    b.corners[1],   b.corners[2],   b.instances};
        pass_ = std::make_unique<ComputePass>(device_, scene_, k_trace_software_spv,
                                              std::span<const VkImageView>(), 4 * sizeof(uint32_t), buffers);
    } else {
        const VkBuffer buffers[] = {rays_.handle(), hits_.handle()};
        pass_ = std::make_unique<ComputePass>(device_, scene_, k_trace_query_spv,
                                              std::span<const VkImageView>(), sizeof(uint32_t), buffers);
    }
}

void RayTracer::record(VkCommandBuffer cmd) const {
    if (launch_) {
        launch_->record(cmd, extentOf(count_), Addresses{rays_.address(), hits_.address(), count_, 0});
    } else if (bvh_) {
        const restir::BvhBuffers b = bvh_->buffers();
        pass_->record(cmd, extentOf(count_), std::array{count_, b.root, b.previousRoot, previous_ ? 1u : 0u});
    } else {
        pass_->record(cmd, extentOf(count_), count_);
    }
    memoryBarrier(cmd, {stage(), VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT}, kHost);
}

std::vector<RayHit> RayTracer::trace(std::span<const restir::gpu::RsLoggedRay> rays, bool previous) {
    count_ = static_cast<uint32_t>(rays.size());
    previous_ = previous;
    rays_ = Buffer(device_, {.size = rays.size_bytes(),
                             .usage = kUsage,
                             .memory = MemoryKind::Upload});
    hits_ = Buffer(device_, {.size = rays.size() * sizeof(RayHit),
                             .usage = kUsage,
                             .memory = MemoryKind::Readback});
    std::memcpy(rays_.mapped(), rays.data(), rays.size_bytes());
    makePass();
    device_.submitAndWait([&](VkCommandBuffer cmd) { record(cmd); });
    std::vector<RayHit> hits(rays.size());
    std::memcpy(hits.data(), hits_.mapped(), hits.size() * sizeof(RayHit));
    return hits;
}

double RayTracer::milliseconds(uint32_t rounds) {
    if (!device_.hasTimestamps() || count_ == 0) return 0;
    const VkQueryPoolCreateInfo info{.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO,
                                     .queryType = VK_QUERY_TYPE_TIMESTAMP,
                                     .queryCount = 2};
    VkQueryPool queries = VK_NULL_HANDLE;
    check(vkCreateQueryPool(device_.handle(), &info, nullptr, &queries), "vkCreateQueryPool");
    double best = 0;
    for (uint32_t round = 0; round < rounds; ++round) {
        device_.submitAndWait([&](VkCommandBuffer cmd) {
            vkCmdResetQueryPool(cmd, queries, 0, 2);
            vkCmdWriteTimestamp2(cmd, stage(), queries, 0);
            record(cmd);
            vkCmdWriteTimestamp2(cmd, stage(), queries, 1);
        });
        uint64_t stamps[2] = {};
        check(vkGetQueryPoolResults(device_.handle(), queries, 0, 2, sizeof stamps, stamps, sizeof(uint64_t),
                                    VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
              "vkGetQueryPoolResults");
        const double ms =
            double(stamps[1] - stamps[0]) * double(device_.properties().limits.timestampPeriod) * 1e-6;
        best = round == 0 ? ms : std::min(best, ms);
    }
    vkDestroyQueryPool(device_.handle(), queries, nullptr);
    return best;
}

}   // namespace samples
