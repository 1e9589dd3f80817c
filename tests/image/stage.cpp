#include "image/stage.h"

#include <array>
#include <numbers>

namespace tests {

using namespace samples::build;

samples::SceneData planeScene() {
    samples::SceneData scene;
    addQuad(scene, {.origin = {-10, 0, 10}, .u = {20, 0, 0}, .v = {0, 0, -20}},
            {.color = kAlbedo, .roughness = 1, .specular = 0});
    scene.views.push_back({.eye = {0, 0.9f, 1.6f}, .target = {0, 0, 0}, .verticalFov = 0.6f});
    return scene;
}

void addQuad(samples::SceneData& scene, const Patch& patch, const Surface& surface) {
    samples::Geometry geometry{.material = addMaterial(scene, surface)};
    addPatch(geometry, patch);
    addInstance(scene, addMesh(scene, {geometry}));
}

Patch lamp(glm::vec3 middle, float half) {
    return {.origin = middle + glm::vec3(-half, 0, -half), .u = {2 * half, 0, 0}, .v = {0, 0, 2 * half}};
}

double polygonIrradiance(std::span<const glm::dvec3> polygon, glm::dvec3 point, glm::dvec3 normal) {
    double sum = 0;
    for (size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec3 a = glm::normalize(polygon[i] - point);
        const glm::dvec3 b = glm::normalize(polygon[(i + 1) % polygon.size()] - point);
        sum += std::acos(glm::dot(a, b)) * glm::dot(glm::normalize(glm::cross(a, b)), normal);
    }
    return 0.5 * sum;
}

double lampIrradiance(const Patch& lamp, glm::dvec3 point) {
    const glm::dvec3 o(lamp.origin), u(lamp.u), v(lamp.v);
    return std::abs(polygonIrradiance(std::array{o, o + u, o + u + v, o + v}, point, {0, 1, 0}));
}

double sphereIrradiance(glm::dvec3 toCentre, double radius) {
    const double distance = glm::length(toCentre);
    return std::numbers::pi * radius * radius * toCentre.y / (distance * distance * distance);
}

double diskIrradiance(glm::dvec3 toCentre, double radius) {
    const double h2 = toCentre.y * toCentre.y, a2 = toCentre.x * toCentre.x + toCentre.z * toCentre.z, r2 = radius * radius;
    return 0.5 * std::numbers::pi * (1 - (h2 + a2 - r2) / std::sqrt((h2 + a2 + r2) * (h2 + a2 + r2) - 4 * r2 * a2));
}

bool planePoint(const samples::CameraPose& pose, VkExtent2D extent, glm::dvec2 pixel, glm::dvec3& point) {
    const glm::dvec2 ndc = 2.0 * pixel / glm::dvec2(extent.width, extent.height) - 1.0;
    const glm::dvec3 direction =
        glm::dvec3(pose.forward) + ndc.x * glm::dvec3(pose.right) - ndc.y * glm::dvec3(pose.up);
    point = glm::dvec3(pose.eye) - direction * (double(pose.eye.y) / direction.y);
    return direction.y < 0;
}

samples::FloatImage planePicture(const samples::View& view, VkExtent2D extent, uint32_t n,
                                const Irradiance& irradiance) {
    const samples::CameraPose pose = samples::makePose(view, extent);
    samples::FloatImage image{extent.width, extent.height, {}};
    for (uint32_t y = 0; y < extent.height; ++y) {
        for (uint32_t x = 0; x < extent.width; ++x) {
            glm::dvec3 sum(0), point;
            for (uint32_t i = 0; i < n * n; ++i) {
                const glm::dvec2 offset = (glm::dvec2(i % n, i / n) + 0.5) / double(n);
                if (planePoint(pose, extent, glm::dvec2(x, y) + offset, point)) sum += irradiance(point);
            }
            sum *= glm::dvec3(kAlbedo) / (std::numbers::pi * n * n);
            for (int c = 0; c < 3; ++c) image.rgb.push_back(float(sum[c]));
        }
    }
    return image;
}

}   // namespace tests
