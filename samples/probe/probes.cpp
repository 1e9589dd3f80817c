#include "probe/probes.h"

#include <array>

#include "probes.spv.h"

namespace probe {
namespace {

constexpr uint32_t kWidth = 64;

struct Constants {
    restir::gpu::uvec2 environmentExtent;
    uint32_t lightCount, width, probeCount, draws, seed;
    float treeShare;
};

}   // namespace

Probes::Probes(const samples::Device& device, const samples::GpuScene& scene,
               const restir::LightTable& lights, uint32_t count)
    : device_(device),
      count_(count),
      lights_(lights.buffers()),
      buffer_(device, {.size = count * sizeof(Probe),
                       .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                       .memory = samples::MemoryKind::Upload}),
      pass_(device, scene, k_probes_spv, {}, sizeof(Constants),
            std::array{lights_.lights, lights_.alias, lights_.environment,
                       lights_.tree ? lights_.tree : lights_.alias, buffer_.handle()}) {}

void Probes::light(uint32_t draws, uint32_t seed, float treeShare) const {
    const Constants constants{
        .environmentExtent = {lights_.environmentExtent.width, lights_.environmentExtent.height},
        .lightCount = lights_.count,
        .width = kWidth,
        .probeCount = count_,
        .draws = draws,
        .seed = seed,
        .treeShare = lights_.tree ? treeShare : 0};
    device_.submitAndWait([&](VkCommandBuffer cmd) {
        pass_.record(cmd, {kWidth, (count_ + kWidth - 1) / kWidth}, constants);
        samples::memoryBarrier(cmd,
                               {VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT},
                               {VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT});
    });
}

}   // namespace probe
