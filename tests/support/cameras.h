// Cameras of every kind that restir::Camera allows.
#pragma once

#include <vector>

#include <glm/glm.hpp>

#include <restir/frame.h>

namespace tests {

struct TestCamera {
    const char* name;
    glm::mat4 viewFromWorld, clipFromView;
    glm::vec2 jitter;   // pixels

    restir::Camera sdk() const;
    // In front of the camera, inside its picture.
    std::vector<glm::vec3> visiblePoints() const;
    // By the definition of the matrices: pixel (jitter included) and the depth that a rasteriser stores.
    glm::dvec3 pixelAndDepth(glm::vec3 position, glm::uvec2 extent) const;
    double linearDepth(glm::vec3 position) const;
};
std::vector<TestCamera> testCameras();

}   // namespace tests
