#include "support/closed_form.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace tests {
namespace {

using restir::Light;
using restir::LightKind;

glm::dvec3 toGlm(const float (&v)[3]) { return {v[0], v[1], v[2]}; }

double rangeWindow(double distance, double range) {
    return range > 0 ? std::clamp(1 - std::pow(distance / range, 4), 0.0, 1.0) : 1;
}

// KHR_lights_punctual's recommended form.
double cone(const Light& light, glm::dvec3 travel) {
    if (light.kind != LightKind::Spot) return 1;
    const double cosine = glm::dot(glm::normalize(toGlm(light.direction)), travel);
    const double inner = std::cos(double(light.innerCone)), outer = std::cos(double(light.outerCone));
    const double t = std::clamp((cosine - outer) / (inner - outer), 0.0, 1.0);
    return t * t;
}

glm::dvec3 triangleLight(const Light& light, glm::dvec3 point, glm::dvec3 n) {
    const std::array<glm::dvec3, 3> corners{toGlm(light.position), toGlm(light.vertex1),
                                            toGlm(light.vertex2)};
    int above = 0;
    for (glm::dvec3 corner : corners) above += glm::dot(corner - point, n) > 0 ? 1 : 0;
    if (above == 0) return glm::dvec3(0);
    if (above != 3) throw std::logic_error("a triangle across the horizon has no closed form here");
    const double irradiance = triangleIrradiance(point, n, corners);
    return toGlm(light.emission) * (light.twoSided ? std::abs(irradiance) : std::max(irradiance, 0.0));
}

}   // namespace

double triangleIrradiance(glm::dvec3 point, glm::dvec3 n, std::span<const glm::dvec3, 3> corners) {
    double sum = 0;
    for (size_t i = 0; i < 3; ++i) {
        const glm::dvec3 a = glm::normalize(corners[i] - point),
                         b = glm::normalize(corners[(i + 1) % 3] - point);
        const glm::dvec3 axis =
            glm::cross(b, a);   // counter-clockwise seen from the point counts as positive
        sum += std::atan2(glm::length(axis), glm::dot(a, b)) * glm::dot(glm::normalize(axis), n);
    }
    return 0.5 * sum;
}

double triangleSolidAngle(glm::dvec3 point, std::span<const glm::dvec3, 3> corners) {
    const glm::dvec3 a = corners[0] - point, b = corners[1] - point, c = corners[2] - point;
    const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
    const double volume = std::abs(glm::dot(a, glm::cross(b, c)));
    return 2 *
           std::atan2(volume, la * lb * lc + glm::dot(a, b) * lc + glm::dot(a, c) * lb + glm::dot(b, c) * la);
}

glm::dvec3 lightIrradiance(const Light& light, glm::dvec3 point, glm::dvec3 n) {
    if (light.kind == LightKind::Triangle) return triangleLight(light, point, n);
    if (light.kind == LightKind::Directional) {
        const glm::dvec3 travel = glm::normalize(toGlm(light.direction));
        return toGlm(light.emission) * std::max(glm::dot(-travel, n), 0.0);
    }
    const glm::dvec3 toLight = toGlm(light.position) - point;
    const double distance = glm::length(toLight);
    const double cosine = std::max(glm::dot(toLight / distance, n), 0.0);
    return toGlm(light.emission) *
           (cone(light, -toLight / distance) * rangeWindow(distance, double(light.range)) * cosine /
            (distance * distance));
}

}   // namespace tests
