// Irradiance at points of a scene, by a shader of the host's own that draws from restir's light tables.
#pragma once

#include <span>

#include <restir/lights.h>

#include "common/scene_pass.h"

namespace probe {

struct Probe {
    glm::vec3 position, normal, irradiance;   // normal 0: irradiance is the fluence, of light from all around
};

class Probes {
public:
    // Of the lights that `lights` recorded last.
    Probes(const samples::Device& device, const samples::GpuScene& scene, const restir::LightTable& lights,
           uint32_t count);

    std::span<Probe> probes() const { return {reinterpret_cast<Probe*>(buffer_.mapped()), count_}; }
    // By so many lights each.
    void light(uint32_t draws, uint32_t seed, float treeShare = 0.75f) const;

private:
    const samples::Device& device_;
    uint32_t count_;
    restir::LightBuffers lights_;
    samples::Buffer buffer_;
    samples::ScenePass pass_;
};

}   // namespace probe
