// own_bridge [picture.png]: builtin:cornell in a host whose G-buffer and materials restir has never heard of.
#include <cstdio>
#include <exception>

#include "own_bridge/host.h"

int main(int argc, char** argv) try {
    constexpr VkExtent2D kExtent{320, 320};
    samples::Device device;
    samples::SceneData data = samples::makeBuiltin("cornell");
    const samples::View view = data.views[0];
    const std::vector<own_bridge::Paint> paints = own_bridge::paintsOf(data);
    const samples::GpuScene scene(device, std::move(data));
    own_bridge::Host host(device, scene, paints, kExtent, device.bestRays());
    const restir::Settings settings{.di = restir::presetSettings(restir::Preset::Balanced)};
    for (uint32_t i = 0; i < 8; ++i) host.frame(samples::orbit(view, 0.5f * float(i)), i, 0, settings);
    samples::writePng(argc > 1 ? argv[1] : "own_bridge.png", host.read(own_bridge::Host::Radiance));
    return 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "own_bridge: %s\n", error.what());
    return 1;
}
