// What the shaders say of one light.
#pragma once

#include <glm/glm.hpp>

#include <lights/environment.h>
#include <lights/pack.h>

#include "support/gpu.h"

namespace tests {

struct LightResult {   // as in lights.glsl
    uint32_t uv;
    glm::vec3 irradiance, direction;
    float distance, solidAngle, pdf;
    uint32_t found;

    // On a triangle; and on anything else.
    glm::dvec2 barycentrics() const { return {(uv & 0xffffu) / 65535.0, (uv >> 16) / 65535.0}; }
    glm::dvec2 square() const { return {((uv & 0xffffu) + 0.5) / 65536, ((uv >> 16) + 0.5) / 65536}; }
};

struct LightRun {
    restir::Light light;
    std::vector<glm::vec3> receivers = {glm::vec3(0)};   // in turn
    uint32_t samples = 1u << 18;
    bool uniformly = false;   // over the domain, instead of as the library draws
    restir::EnvironmentMap environment = {};
    uint32_t seed = 5;
};
std::vector<LightResult> runLight(const LightRun& run);

}   // namespace tests
