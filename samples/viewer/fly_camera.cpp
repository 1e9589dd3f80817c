#include "viewer/fly_camera.h"

#include <algorithm>
#include <cmath>

#include "common/camera.h"

namespace viewer {

void FlyCamera::place(const samples::View& view) {
    view_ = view;
    speed = 0.5f * glm::distance(view.eye, view.target);
}

void FlyCamera::fly(const Flight& flight, float seconds) {
    const glm::vec3 up = glm::normalize(view_.up);
    const float distance = glm::distance(view_.target, view_.eye);
    glm::vec3 forward = (view_.target - view_.eye) / distance;
    // Heading and height above the horizon; straight up and down are left out, where there is no heading.
    const float steepest = 1.55f, height = std::asin(std::clamp(glm::dot(forward, up), -1.0f, 1.0f));
    const glm::vec3 level = glm::normalize(forward - glm::dot(forward, up) * up);
    const glm::vec3 right = glm::cross(level, up);
    if (flight.turn != glm::vec2(0)) {
        const float turned = std::clamp(height + flight.turn.y, -steepest, steepest);
        const glm::vec3 heading = std::cos(flight.turn.x) * level + std::sin(flight.turn.x) * right;
        forward = std::cos(turned) * heading + std::sin(turned) * up;
    }
    const glm::vec3 move = flight.move.x * right + flight.move.y * up + flight.move.z * forward;
    view_.eye += speed * flight.haste * seconds * move;
    view_.target = view_.eye + distance * forward;
}

void FlyCamera::orbit(float angle) { view_ = samples::orbit(view_, glm::degrees(angle)); }

}   // namespace viewer
