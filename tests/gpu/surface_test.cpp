// Packed surfaces, cameras and reservoirs on the device.
#include <cmath>
#include <limits>
#include <random>

#include <frame/constants.h>

#include "gpu/values.h"
#include "support/cameras.h"

namespace {

using tests::Record;
using tests::RecordOf;
using tests::TestCamera;
using tests::Value;

constexpr glm::uvec2 kExtent{640, 400};

class SurfaceTest : public tests::GpuTest {};
class ReservoirTest : public tests::GpuTest {};

std::vector<restir::gpu::RsView> viewsOf(const std::vector<TestCamera>& cameras) {
    std::vector<restir::gpu::RsView> views;
    for (const TestCamera& camera : cameras)
        views.push_back(restir::makeView(camera.sdk(), {kExtent.x, kExtent.y}));
    return views;
}

TEST_F(SurfaceTest, PositionsGoToPixelsAndBack) {
    const std::vector<TestCamera> cameras = tests::testCameras();
    std::vector<Record> records;
    for (uint32_t c = 0; c < cameras.size(); ++c)
        for (glm::vec3 point : cameras[c].visiblePoints())
            records.push_back(RecordOf(Value::Projected)
                                  .add(c)
                                  .add(kExtent.x)
                                  .add(kExtent.y)
                                  .add(point)
                                  .add(static_cast<float>(cameras[c].pixelAndDepth(point, kExtent).z)));
    const std::vector<Record> results = tests::evaluate(records, viewsOf(cameras));
    for (size_t i = 0; i < records.size(); ++i) {
        const TestCamera& camera = cameras[records[i].words[1]];
        SCOPED_TRACE(camera.name);
        const glm::vec3 point = records[i].vector(4);
        const glm::dvec3 expected = camera.pixelAndDepth(point, kExtent);
        const double depth = camera.linearDepth(point);
        // 32-bit coordinates of a point this near the eye, in pixels.
        const double rounding = kExtent.x * 2.5e-7 * (1 + double(glm::length(point)) / depth);
        const double metres = 2.5e-7 * (double(glm::length(point)) + depth);
        EXPECT_NEAR(results[i].value(0), expected.x, rounding);
        EXPECT_NEAR(results[i].value(1), expected.y, rounding);
        EXPECT_NEAR(results[i].value(2), depth, metres);
        EXPECT_LT(glm::distance(results[i].vector(3), point), 8 * metres);
        // 32-bit device depth near 1 resolves z to about 2^-24 z^2 / near.
        EXPECT_NEAR(results[i].value(6), depth, depth * depth * 2e-6 + 1e-4 * depth);
    }
}

TEST_F(SurfaceTest, TowardsTheEyeIsUnitAndRight) {
    const std::vector<TestCamera> cameras = tests::testCameras();
    std::vector<Record> records;
    for (uint32_t c = 0; c < cameras.size(); ++c)
        records.push_back(RecordOf(Value::Projected)
                              .add(c)
                              .add(kExtent.x)
                              .add(kExtent.y)
                              .add(cameras[c].visiblePoints()[5]));
    const std::vector<Record> results = tests::evaluate(records, viewsOf(cameras));
    for (size_t i = 0; i < records.size(); ++i) {
        const glm::dmat4 worldFromView = glm::inverse(glm::dmat4(cameras[i].viewFromWorld));
        const glm::dvec3 eye(worldFromView[3]), point = records[i].vector(4);
        const bool orthographic = cameras[i].clipFromView[2][3] == 0;
        const glm::dvec3 expected = glm::normalize(orthographic ? glm::dvec3(worldFromView[2]) : eye - point);
        EXPECT_LT(glm::distance(glm::dvec3(results[i].vector(9)), expected), 1e-5) << cameras[i].name;
    }
}

TEST_F(SurfaceTest, SurvivesItsTwentyFourBytes) {
    std::mt19937 random(5);
    std::normal_distribution<float> normal;
    std::uniform_real_distribution<float> unit(0, 1);
    std::vector<Record> records;
    for (uint32_t i = 0; i < 2000; ++i)
        records.push_back(RecordOf(Value::Surface)
                              .add(i % 50 ? 1u : 0u)
                              .add(0.5f + 30 * unit(random))
                              .add(glm::vec3(normal(random), normal(random), normal(random)))
                              .add(glm::vec3(normal(random), normal(random), normal(random)))
                              .add(glm::vec3(unit(random), unit(random), unit(random)))
                              .add(unit(random))
                              .add(unit(random))
                              .add(unit(random))
                              .add(i * 77777u));
    const std::vector<Record> results = tests::evaluate(records, viewsOf(tests::testCameras()));
    for (size_t i = 0; i < records.size(); ++i) {
        ASSERT_EQ(results[i].words[0], records[i].words[1]);
        if (!results[i].words[0]) continue;
        EXPECT_EQ(results[i].words[1], records[i].words[2]) << "depth is kept exactly";
        EXPECT_LT(glm::distance(results[i].vector(2), glm::normalize(records[i].vector(3))), 7e-5);
        EXPECT_LT(glm::distance(results[i].vector(5), glm::normalize(records[i].vector(6))), 7e-5);
        for (int k = 0; k < 3; ++k) {
            EXPECT_NEAR(results[i].vector(8)[k], records[i].vector(9)[k], 1e-3);
            EXPECT_NEAR(results[i].vector(11)[k], records[i].vector(12)[k], 0.5 / 255 + 1e-6);
        }
        EXPECT_EQ(results[i].words[14], records[i].words[15]);
        EXPECT_LT(results[i].value(15), 1e-2) << "the position lies under its pixel";
    }
}

TEST_F(SurfaceTest, NormalsFaceTheViewer) {
    std::mt19937 random(6);
    std::normal_distribution<float> normal;
    const auto direction = [&] {
        return glm::normalize(glm::vec3(normal(random), normal(random), normal(random)));
    };
    std::vector<Record> records;
    for (int i = 0; i < 4000; ++i)
        records.push_back(RecordOf(Value::Faced).add(direction()).add(direction()).add(direction()));
    const std::vector<Record> results = tests::evaluate(records);
    for (size_t i = 0; i < records.size(); ++i) {
        const glm::vec3 view = records[i].vector(7), shading = results[i].vector(0),
                        geometric = results[i].vector(3);
        EXPECT_GE(glm::dot(geometric, view), 0);
        EXPECT_GE(glm::dot(shading, view), 9e-4f);
        EXPECT_NEAR(glm::length(shading), 1, 1e-5);
        EXPECT_NEAR(std::abs(glm::dot(geometric, records[i].vector(4))), 1, 1e-5);
    }
}

Record reservoir(float ucw, uint32_t confidence, uint32_t age) {
    return RecordOf(Value::Reservoir).add(5u).add(0x12345678u).add(ucw).add(confidence).add(age);
}

TEST_F(ReservoirTest, KeepsAGoodWeight) {
    for (float ucw : {1e-30f, 1.0f, 1e30f}) {
        const Record r = tests::evaluate({reservoir(ucw, 7, 9)})[0];
        EXPECT_EQ(r.words[0], 5u);
        EXPECT_EQ(r.words[1], 0x12345678u);
        EXPECT_EQ(r.value(2), ucw);
        EXPECT_EQ(r.words[3], 7u);
        EXPECT_EQ(r.words[4], 9u);
        EXPECT_EQ(r.words[5], 1u);
        EXPECT_EQ(r.words[6], 0u);
    }
}

TEST_F(ReservoirTest, RejectsABadWeightAndKeepsItsConfidence) {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    for (float ucw : {std::numeric_limits<float>::quiet_NaN(), kInfinity, -kInfinity, -1.0f, -1e-30f}) {
        const Record r = tests::evaluate({reservoir(ucw, 12, 3)})[0];
        EXPECT_EQ(r.words[0], RS_NO_LIGHT) << ucw;
        EXPECT_EQ(r.words[2], 0u) << ucw;
        EXPECT_EQ(r.words[3], 12u) << ucw;
        EXPECT_EQ(r.words[5], 0u) << ucw;
        EXPECT_EQ(r.words[6], 1u) << ucw << " was not counted";
    }
}

TEST_F(ReservoirTest, ZeroIsEmptyButNotRejected) {
    for (float zero : {0.0f, -0.0f}) {
        const Record r = tests::evaluate({reservoir(zero, 3, 0)})[0];
        EXPECT_EQ(r.words[0], RS_NO_LIGHT);
        EXPECT_EQ(r.words[2], 0u);
        EXPECT_EQ(r.words[3], 3u);
        EXPECT_EQ(r.words[6], 0u);
    }
}

TEST_F(ReservoirTest, ConfidenceAndAgeSaturate) {
    const std::vector<Record> results =
        tests::evaluate({reservoir(1, 65535, 65535), reservoir(1, 65536, 65536), reservoir(0, 1u << 20, 0)});
    for (const Record& r : results) EXPECT_EQ(r.words[3], 65535u);
    EXPECT_EQ(results[0].words[4], 65535u);
    EXPECT_EQ(results[1].words[4], 65535u);
}

}   // namespace
