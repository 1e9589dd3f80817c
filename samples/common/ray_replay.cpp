#include "common/ray_replay.h"

#include <algorithm>
#include <cstdint>

#include <ray_replay.spv.h>
#include <ray_replay_raygen.spv.h>

namespace samples {

double replayRays(const Device& device, const GpuScene& scene, VkBuffer rayLog, uint32_t rays, uint32_t rounds) {
    if (!device.hasTimestamps() || rays == 0) return 0;
    const VkBuffer buffers[] = {rayLog};
    const ScenePass pass(device, scene, tracingShader(device, k_ray_replay_spv, k_ray_replay_raygen_spv), {}, sizeof(uint32_t), buffers);
    const VkQueryPoolCreateInfo info{
        .sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO, .queryType = VK_QUERY_TYPE_TIMESTAMP, .queryCount = 2};
    VkQueryPool queries = VK_NULL_HANDLE;
    check(vkCreateQueryPool(device.handle(), &info, nullptr, &queries), "vkCreateQueryPool");

    double best = 0;
    for (uint32_t round = 0; round <= rounds; ++round) {
        device.submitAndWait([&](VkCommandBuffer cmd) {
            vkCmdResetQueryPool(cmd, queries, 0, 2);
            vkCmdWriteTimestamp2(cmd, pass.stage(), queries, 0);
            pass.recordList(cmd, rays, rays);
            vkCmdWriteTimestamp2(cmd, pass.stage(), queries, 1);
        });
        uint64_t stamps[2] = {};
        check(vkGetQueryPoolResults(device.handle(), queries, 0, 2, sizeof stamps, stamps, sizeof(uint64_t),
                                    VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
              "vkGetQueryPoolResults");
        const double ms = double(stamps[1] - stamps[0]) * double(device.properties().limits.timestampPeriod) * 1e-6;
        if (round > 0) best = best == 0 ? ms : std::min(best, ms);
    }
    vkDestroyQueryPool(device.handle(), queries, nullptr);
    return best;
}

}   // namespace samples
