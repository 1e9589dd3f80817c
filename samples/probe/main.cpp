// probe [picture.png]: how bright it is 1.5 m over the ground of builtin:market, seen from above.
#include <cstdio>
#include <exception>

#include "common/lighting.h"
#include "probe/probes.h"

int main(int argc, char** argv) try {
    constexpr uint32_t kSide = 128, kDraws = 512;
    samples::Device device;
    samples::SceneData data = samples::makeBuiltin("market");
    const glm::vec3 middle = data.views[0].target;
    samples::GpuScene scene(device, std::move(data));
    const samples::Lighting lighting(device, scene);
    const probe::Probes probes(device, scene, lighting.lights(), kSide * kSide);
    for (uint32_t i = 0; i < kSide * kSide; ++i) {
        const glm::vec2 at = (glm::vec2(i % kSide, i / kSide) + 0.5f) / float(kSide) - 0.5f;
        probes.probes()[i] = {{middle.x + 10 * at.x, 1.5f, middle.z + 10 * at.y}, {0, 1, 0}, {}};
    }
    probes.light(kDraws, 0);
    samples::FloatImage image{kSide, kSide, {}};
    for (const probe::Probe& p : probes.probes())
        image.rgb.insert(image.rgb.end(), {p.irradiance.x, p.irradiance.y, p.irradiance.z});
    samples::writePng(argc > 1 ? argv[1] : "probe.png", image);
    return 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "probe: %s\n", error.what());
    return 1;
}
