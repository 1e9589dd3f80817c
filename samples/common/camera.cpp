#include "common/camera.h"

#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

namespace samples {
namespace {

// Some direction that is not parallel to `forward`.
glm::vec3 usableUp(const glm::vec3& forward, const glm::vec3& up) {
    if (glm::length(glm::cross(forward, up)) > 1e-6f * glm::length(up)) return up;
    return std::abs(forward.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
}

}   // namespace

CameraPose makePose(const View& view, VkExtent2D extent) {
    CameraPose pose;
    pose.eye = view.eye;
    pose.forward = glm::normalize(view.target - view.eye);
    const glm::vec3 right = glm::normalize(glm::cross(pose.forward, usableUp(pose.forward, view.up)));
    const float halfHeight = std::tan(0.5f * view.verticalFov);
    const float aspect = static_cast<float>(extent.width) / static_cast<float>(extent.height);
    pose.up = halfHeight * glm::cross(right, pose.forward);
    pose.right = halfHeight * aspect * right;
    return pose;
}

restir::Camera sdkCamera(const CameraPose& pose, glm::vec2 jitter) {
    const float halfWidth = glm::length(pose.right), halfHeight = glm::length(pose.up);
    const glm::vec3 x = pose.right / halfWidth, y = pose.up / halfHeight, z = -pose.forward;
    glm::mat4 viewFromWorld(1.0f);
    const glm::vec3 rows[3] = {x, y, z};
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) viewFromWorld[column][row] = rows[row][column];
        viewFromWorld[3][row] = -glm::dot(rows[row], pose.eye);
    }
    glm::mat4 clipFromView(0.0f);   // reversed, infinite; Vulkan's y points down
    clipFromView[0][0] = 1 / halfWidth;
    clipFromView[1][1] = -1 / halfHeight;
    clipFromView[2][3] = -1;
    clipFromView[3][2] = 0.01f;
    return {.viewFromWorld = restir::Mat4::from(viewFromWorld),
            .clipFromView = restir::Mat4::from(clipFromView),
            .jitter = {jitter.x, jitter.y}};
}

View orbit(const View& view, float degrees) {
    const glm::mat4 turn = glm::rotate(glm::mat4(1.0f), glm::radians(degrees), glm::normalize(view.up));
    View turned = view;
    turned.eye = view.target + glm::vec3(turn * glm::vec4(view.eye - view.target, 0.0f));
    return turned;
}

uint32_t hash(uint32_t value) {   // Wellons' lowbias32
    value = (value ^ (value >> 16)) * 0x7feb352du;
    value = (value ^ (value >> 15)) * 0x846ca68bu;
    return value ^ (value >> 16);
}

glm::vec2 jitterOf(uint32_t index, uint32_t seed) {
    // In integers: exact, however long the sequence is.
    const uint32_t x = hash(seed) + index * 3242174889u;                 // 2^32 / 1.3247
    const uint32_t y = hash(seed ^ 0x9e3779b9u) + index * 2447445414u;   // 2^32 / 1.3247^2
    return glm::vec2(static_cast<float>(x >> 8), static_cast<float>(y >> 8)) / 16777216.0f - 0.5f;
}

}   // namespace samples
