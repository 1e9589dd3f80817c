// RsView against the matrices it is made from, in the words of shaders/restir/core/view.glsl.
#include <frame/constants.h>

#include <gtest/gtest.h>

#include "support/cameras.h"

namespace {

using restir::gpu::RsView;
using tests::TestCamera;

constexpr glm::uvec2 kExtent{640, 400};

RsView viewOf(const TestCamera& camera) { return restir::makeView(camera.sdk(), {kExtent.x, kExtent.y}); }

glm::dvec3 toGlm(restir::gpu::vec3 v) { return {v.x, v.y, v.z}; }
double affine(restir::gpu::vec4 row, glm::dvec3 p) {
    return double(row.x) * p.x + double(row.y) * p.y + double(row.z) * p.z + double(row.w);
}

double depthOf(const RsView& view, glm::dvec3 p) {
    return double(view.zSign) * affine(view.viewFromWorld[2], p);
}

glm::dvec2 pixelOf(const RsView& view, glm::dvec3 p) {
    const double depth = depthOf(view, p), w = view.perspective > 0.5f ? depth : 1;
    const glm::dvec2 xy(affine(view.viewFromWorld[0], p), affine(view.viewFromWorld[1], p));
    const glm::dvec2 ndc(
        (xy.x * double(view.projection.x) + double(view.projection.z) * depth + double(view.translation.x)) /
            w,
        (xy.y * double(view.projection.y) + double(view.projection.w) * depth + double(view.translation.y)) /
            w);
    return ((ndc + glm::dvec2(view.jitter.x, view.jitter.y)) * 0.5 + 0.5) * glm::dvec2(kExtent);
}

glm::dvec3 positionOf(const RsView& view, glm::dvec2 pixel, double depth) {
    const glm::dvec2 ndc = pixel / glm::dvec2(kExtent) * 2.0 - 1.0 - glm::dvec2(view.jitter.x, view.jitter.y);
    const double w = view.perspective > 0.5f ? depth : 1;
    const double x = (ndc.x * w - double(view.projection.z) * depth - double(view.translation.x)) /
                     double(view.projection.x);
    const double y = (ndc.y * w - double(view.projection.w) * depth - double(view.translation.y)) /
                     double(view.projection.y);
    return toGlm(view.eye) + toGlm(view.axisX) * x + toGlm(view.axisY) * y +
           toGlm(view.axisZ) * (double(view.zSign) * depth);
}

double depthFromDevice(const RsView& view, double device) {
    const auto& t = view.depthTerms;
    return double(view.zSign) * (double(t.y) - device * double(t.w)) / (device * double(t.z) - double(t.x));
}

TEST(View, PixelsAndDepthsAreThoseOfTheMatrices) {
    for (const TestCamera& camera : tests::testCameras()) {
        SCOPED_TRACE(camera.name);
        const RsView view = viewOf(camera);
        for (glm::vec3 point : camera.visiblePoints()) {
            const glm::dvec3 expected = camera.pixelAndDepth(point, kExtent);
            const glm::dvec2 pixel = pixelOf(view, point);
            EXPECT_NEAR(pixel.x, expected.x, 1e-3);
            EXPECT_NEAR(pixel.y, expected.y, 1e-3);
            const double depth = camera.linearDepth(point);
            EXPECT_NEAR(depthOf(view, point), depth, 1e-5 * depth);
            EXPECT_NEAR(depthFromDevice(view, expected.z), depth, 1e-3 * depth);
        }
    }
}

TEST(View, PositionsComeBack) {
    for (const TestCamera& camera : tests::testCameras()) {
        SCOPED_TRACE(camera.name);
        const RsView view = viewOf(camera);
        for (glm::vec3 point : camera.visiblePoints()) {
            const glm::dvec3 back = positionOf(view, pixelOf(view, point), depthOf(view, point));
            EXPECT_LT(glm::length(back - glm::dvec3(point)),
                      1e-5 * (glm::length(glm::dvec3(point)) + depthOf(view, point)));
        }
    }
}

TEST(View, EyeIsWhereTheViewIsZero) {
    for (const TestCamera& camera : tests::testCameras()) {
        const RsView view = viewOf(camera);
        const glm::dvec4 origin = glm::dmat4(camera.viewFromWorld) * glm::dvec4(toGlm(view.eye), 1);
        EXPECT_LT(glm::length(glm::dvec3(origin)), 1e-5) << camera.name;
    }
}

TEST(View, KindsOfProjection) {
    const auto cameras = tests::testCameras();
    for (const TestCamera& camera : cameras) {
        const bool orthographic = std::string(camera.name) == "orthographic";
        EXPECT_EQ(viewOf(camera).perspective, orthographic ? 0 : 1) << camera.name;
        const bool left = std::string(camera.name).starts_with("left");
        EXPECT_EQ(viewOf(camera).zSign, left ? 1 : -1) << camera.name;
    }
}

}   // namespace
