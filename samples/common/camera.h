// Views as the shaders and the SDK take them, and how they move over a sequence.
#pragma once

#include <vulkan/vulkan_core.h>

#include <restir/frame.h>

#include "common/scene.h"

namespace samples {

// CameraPose in camera.glsl.
struct CameraPose {
    glm::vec3 eye{0};
    glm::vec3 right{1, 0, 0};      // length tan(half horizontal field of view)
    glm::vec3 up{0, 1, 0};         // length tan(half vertical field of view)
    glm::vec3 forward{0, 0, -1};   // unit
};

CameraPose makePose(const View& view, VkExtent2D extent);
restir::Camera sdkCamera(const CameraPose& pose, glm::vec2 jitter);

// The view turned about the up axis through its target.
View orbit(const View& view, float degrees);

// Offset in pixels of frame `index`, uniform over (-1/2, 1/2)^2 and evenly spread over a sequence: a
// rotated R2 sequence (Roberts 2018), so that every seed has its own.
glm::vec2 jitterOf(uint32_t index, uint32_t seed);

// Scatters the bits of small, consecutive numbers.
uint32_t hash(uint32_t value);

}   // namespace samples
