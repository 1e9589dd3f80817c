#include "light_run.h"

#include <gtest/gtest.h>

#include "lights.spv.h"

namespace tests {
namespace {

struct Parameters {   // as in lights.glsl
    uint32_t seed, receivers, uniformly, width, height;
    restir::gpu::RsPackedLight light;
};

}   // namespace

std::vector<LightResult> runLight(const LightRun& run) {
    static const Kernel kernel(k_lights_spv, 4);
    restir::EnvironmentImportance table{.texels = std::vector<restir::gpu::RsEnvironmentTexel>(1)};
    restir::LightPacker packer({.lights = 1, .textures = 8});
    if (run.environment.width > 0) {
        table = restir::weighEnvironment(run.environment);
        packer.environmentHas(table.luminance);
    }
    restir::gpu::RsPackedLight packed;
    restir::PackedLights said;
    EXPECT_EQ(packer.pack({}, {&run.light, 1}, &packed, said), restir::Status::Ok);
    const std::vector<Parameters> parameters{{run.seed, static_cast<uint32_t>(run.receivers.size()),
                                              run.uniformly, run.environment.width, run.environment.height,
                                              packed}};
    std::vector<LightResult> results(run.samples);
    kernel.run(run.samples / 64, {in(parameters), in(run.receivers), in(table.texels), out(results)});
    return results;
}

}   // namespace tests
