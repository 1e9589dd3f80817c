// A diffuse plane at y = 0 with lights over it, and what it must look like.
#pragma once

#include <functional>
#include <span>

#include <common/camera.h>
#include <common/image_io.h>
#include <common/mesh_builder.h>

namespace tests {

// In 10 bits over a square root exactly, as surfaces are packed.
inline constexpr glm::vec3 kAlbedo{1.0f, 512.0f * 512.0f / (1023.0f * 1023.0f), 256.0f * 256.0f / (1023.0f * 1023.0f)};

// The plane, and a camera under the height of 0.9 that sees nothing but it.
samples::SceneData planeScene();
// A quad whose front is on the side of u x v.
void addQuad(samples::SceneData& scene, const samples::build::Patch& patch, const samples::build::Surface& surface);
// Corners `half` from the middle, facing down.
samples::build::Patch lamp(glm::vec3 middle, float half);

// Lambert's formula: irradiance from a polygon of radiance 1, counter-clockwise as seen from `point`.
double polygonIrradiance(std::span<const glm::dvec3> polygon, glm::dvec3 point, glm::dvec3 normal);
double lampIrradiance(const samples::build::Patch& lamp, glm::dvec3 point);   // on the plane
// On the plane, by a light of radiance 1 that is `toCentre` away: a sphere wholly above it, and a disk that faces it.
double sphereIrradiance(glm::dvec3 toCentre, double radius);
double diskIrradiance(glm::dvec3 toCentre, double radius);

// The plane from the irradiance at each of its points, as the mean over n x n positions in a pixel.
using Irradiance = std::function<glm::dvec3(glm::dvec3)>;
samples::FloatImage planePicture(const samples::View& view, VkExtent2D extent, uint32_t n,
                                const Irradiance& irradiance);
// Where the centre of a pixel sees the plane; false: it does not.
bool planePoint(const samples::CameraPose& pose, VkExtent2D extent, glm::dvec2 pixel, glm::dvec3& point);

}   // namespace tests
