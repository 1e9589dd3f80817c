// What lights do to a point, in closed form and double precision; nothing shared with the SDK.
#pragma once

#include <span>

#include <glm/glm.hpp>

#include <restir/lights.h>

namespace tests {

// Lambert 1760: irradiance at `point` on a plane of normal `n` by a triangle of radiance 1 that lies above
// that plane. Negative where the triangle shows its back (clockwise).
double triangleIrradiance(glm::dvec3 point, glm::dvec3 n, std::span<const glm::dvec3, 3> corners);
// Van Oosterom & Strackee 1983; positive.
double triangleSolidAngle(glm::dvec3 point, std::span<const glm::dvec3, 3> corners);

// Irradiance by one light at a point on a plane; each light must be wholly above or below it.
glm::dvec3 lightIrradiance(const restir::Light& light, glm::dvec3 point, glm::dvec3 n);

}   // namespace tests
