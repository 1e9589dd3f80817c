#include "support/cameras.h"

#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

namespace tests {
namespace {

glm::mat4 flipped(glm::mat4 clip) {   // Vulkan's y points down
    for (int column = 0; column < 4; ++column) clip[column][1] = -clip[column][1];
    return clip;
}

glm::mat4 reversedInfinite() {
    glm::mat4 clip(0.0f);
    clip[0][0] = 1.1f;
    clip[1][1] = -1.7f;
    clip[2][3] = -1;
    clip[3][2] = 0.05f;
    return clip;
}

}   // namespace

restir::Camera TestCamera::sdk() const {
    return {.viewFromWorld = restir::Mat4::from(viewFromWorld),
            .clipFromView = restir::Mat4::from(clipFromView),
            .jitter = {jitter.x, jitter.y}};
}

std::vector<glm::vec3> TestCamera::visiblePoints() const {
    const glm::dmat4 viewFromClip = glm::inverse(glm::dmat4(clipFromView));
    const glm::dmat4 worldFromView = glm::inverse(glm::dmat4(viewFromWorld));
    std::vector<glm::vec3> points;
    for (double x : {-0.9, 0.1, 0.95}) {
        for (double y : {-0.8, 0.3, 0.85}) {
            for (double depth : {0.2, 0.7, 0.95}) {
                const glm::dvec4 view = viewFromClip * glm::dvec4(x, y, depth, 1);
                points.emplace_back(worldFromView * glm::dvec4(glm::dvec3(view) / view.w, 1));
            }
        }
    }
    return points;
}

glm::dvec3 TestCamera::pixelAndDepth(glm::vec3 position, glm::uvec2 extent) const {
    glm::dvec4 clip = glm::dmat4(clipFromView) * (glm::dmat4(viewFromWorld) * glm::dvec4(position, 1));
    clip.x += 2.0 * jitter.x / extent.x * clip.w;
    clip.y += 2.0 * jitter.y / extent.y * clip.w;
    const glm::dvec3 ndc = glm::dvec3(clip) / clip.w;
    return {(ndc.x * 0.5 + 0.5) * extent.x, (ndc.y * 0.5 + 0.5) * extent.y, ndc.z};
}

double TestCamera::linearDepth(glm::vec3 position) const {
    return std::abs((glm::dmat4(viewFromWorld) * glm::dvec4(position, 1)).z);
}

std::vector<TestCamera> testCameras() {
    const glm::mat4 rightHanded =
        glm::lookAtRH(glm::vec3(3, 2, 5), glm::vec3(0, 1, 0), glm::vec3(0, 1, 0.2f));
    const glm::mat4 leftHanded = glm::lookAtLH(glm::vec3(-4, 3, 1), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0));
    const glm::mat4 scaled = glm::scale(glm::mat4(1), glm::vec3(1, 1, 2)) * rightHanded;
    return {
        {"right-handed", rightHanded, flipped(glm::perspectiveRH_ZO(0.9f, 1.6f, 0.5f, 60.0f)), {0, 0}},
        {"left-handed", leftHanded, flipped(glm::perspectiveLH_ZO(1.2f, 1.6f, 0.5f, 60.0f)), {0.4f, -0.3f}},
        {"off-centre",
         rightHanded,
         flipped(glm::frustumRH_ZO(-0.2f, 0.5f, -0.1f, 0.4f, 0.5f, 40.0f)),
         {-0.25f, 0.45f}},
        {"left-handed off-centre",
         leftHanded,
         glm::frustumLH_ZO(-0.4f, 0.1f, -0.3f, 0.2f, 0.5f, 40.0f),
         {0.2f, 0.1f}},
        {"reversed infinite", rightHanded, reversedInfinite(), {0.5f, 0.5f}},
        {"orthographic",
         rightHanded,
         flipped(glm::orthoRH_ZO(-2.0f, 3.0f, -1.5f, 1.0f, 0.5f, 30.0f)),
         {0.3f, -0.1f}},
        {"scaled view", scaled, flipped(glm::perspectiveRH_ZO(0.9f, 1.6f, 0.5f, 60.0f)), {0, 0}},
    };
}

}   // namespace tests
