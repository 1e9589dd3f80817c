// An axis-aligned box around a scene.
#pragma once

#include <limits>

#include <glm/glm.hpp>

#include "scene.h"

namespace samples {

struct Bounds {
    glm::vec3 lo{std::numeric_limits<float>::max()}, hi{std::numeric_limits<float>::lowest()};

    void add(const glm::vec3& point) {
        lo = glm::min(lo, point);
        hi = glm::max(hi, point);
    }
    bool empty() const { return lo.x > hi.x; }
    glm::vec3 centre() const { return 0.5f * (lo + hi); }
};

// World-space box of all instances; each contributes the transformed box of its mesh.
Bounds sceneBounds(const SceneData& scene);

}   // namespace samples
