#include "common/ray_tracer.h"

#include <algorithm>
#include <array>
#include <cstring>

#include <trace.spv.h>
#include <trace_raygen.spv.h>
#include <trace_software.spv.h>

namespace samples {
namespace {

constexpr Access kHost{VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT};

}   // namespace

RayTracer::RayTracer(const Device& device, const GpuScene& scene, restir::RayBackend rays,
                     const restir::Bvh* bvh)
    : device_(device), scene_(scene), backend_(rays), bvh_(bvh) {}

void RayTracer::makePass() {
    if (bvh_) {
        const restir::BvhBuffers b = bvh_->buffers();
        const VkBuffer buffers[] = {rays_.handle(), hits_.handle(), b.nodes,    b.corners[0],
                                    b.corners[1],   b.corners[2],   b.instances};
        pass_ = std::make_unique<ScenePass>(device_, scene_, k_trace_software_spv,
                                            std::span<const VkImageView>(), 4 * sizeof(uint32_t), buffers);
    } else {
        const bool raygen = backend_ == restir::RayBackend::Pipeline;
        const PassShader shader = raygen ? PassShader(k_trace_raygen_spv, true) : PassShader(k_trace_spv);
        const VkBuffer buffers[] = {rays_.handle(), hits_.handle()};
        pass_ = std::make_unique<ScenePass>(device_, scene_, shader, std::span<const VkImageView>(), sizeof(uint32_t),
                                            buffers);
    }
}

void RayTracer::record(VkCommandBuffer cmd) const {
    if (bvh_) {
        const restir::BvhBuffers b = bvh_->buffers();
        pass_->recordList(cmd, count_, std::array{count_, b.root, b.previousRoot, previous_ ? 1u : 0u});
    } else {
        pass_->recordList(cmd, count_, count_);
    }
    memoryBarrier(cmd, {pass_->stage(), VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT}, kHost);
}

std::vector<RayHit> RayTracer::trace(std::span<const restir::gpu::RsLoggedRay> rays, bool previous) {
    count_ = static_cast<uint32_t>(rays.size());
    previous_ = previous;
    rays_ = Buffer(device_, {.size = rays.size_bytes(),
                             .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                             .memory = MemoryKind::Upload});
    hits_ = Buffer(device_, {.size = rays.size() * sizeof(RayHit),
                             .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
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
            vkCmdWriteTimestamp2(cmd, pass_->stage(), queries, 0);
            record(cmd);
            vkCmdWriteTimestamp2(cmd, pass_->stage(), queries, 1);
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
