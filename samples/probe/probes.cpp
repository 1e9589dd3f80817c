#include "probe/probes.h"

#include <array>

#include "probes.spv.h"
#include "probes_raygen.spv.h"

namespace probe {
namespace {

struct Constants {
    restir::gpu::uvec2 environmentExtent;
    uint32_t lightCount, probeCount, draws, seed;
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
      pass_(device, scene, samples::tracingShader(device, k_probes_spv, k_probes_raygen_spv), {}, sizeof(Constants),
            std::array{lights_.lights, lights_.alias, lights_.environment,
                       lights_.tree ? lights_.tree : lights_.alias, buffer_.handle()}) {}

void Probes::light(uint32_t draws, uint32_t seed, float treeShare) const {
    const Constants constants{
        .environmentExtent = {lights_.environmentExtent.width, lights_.environmentExtent.height},
        .lightCount = lights_.count,
        .probeCount = count_,
        .draws = draws,
        .seed = seed,
        .treeShare = lights_.tree ? treeShare : 0};
    device_.submitAndWait([&](VkCommandBuffer cmd) {
        pass_.recordList(cmd, count_, constants);
        samples::memoryBarrier(cmd,
                               {pass_.stage(), VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT},
                               {VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT});
    });
}

}   // namespace probe
