// The software ray backend ray by ray: closed forms, and what is hard for it.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include <common/mesh_builder.h>
#include <common/ray_lists.h>

#include "image/stage.h"
#include "image/world.h"

namespace tests {
namespace {

using samples::makeRay;
using samples::RayHit;
using samples::RsLoggedRay;

constexpr float kInfinity = std::numeric_limits<float>::infinity(),
                kNan = std::numeric_limits<float>::quiet_NaN();

struct Mesh {
    std::vector<glm::vec3> positions;
    std::vector<uint32_t> indices;

    void add(glm::vec3 a, glm::vec3 b, glm::vec3 c) {
        for (const glm::vec3& p : {a, b, c}) {
            indices.push_back(uint32_t(positions.size()));
            positions.push_back(p);
        }
    }
    restir::BvhMesh build() const {
        const restir::BvhGeometry geometry{
            .positions = {reinterpret_cast<const float*>(positions.data()), 3 * positions.size()},
            .indices = indices};
        return device().require(restir::BvhMesh::create({.geometries = {&geometry, 1}}), "BvhMesh");
    }
};

restir::BvhInstance instanceOf(uint32_t mesh, uint32_t record, const glm::mat4& transform = glm::mat4(1)) {
    restir::BvhInstance result{.mesh = mesh, .record = record};
    samples::Rows rows = samples::rowsOf(transform);
    std::memcpy(result.worldFromObject, &rows, sizeof rows);
    return result;
}

class SoftwareRays : public testing::Test {
protected:
    static const restir::Context& context() {
        static const restir::Context made = [] {
            restir::ContextDesc desc{.device = device().sdkInfo(), .rays = restir::RayBackend::Software};
            desc.queueFamily = device().queueFamily();
            return device().require(restir::Context::create(desc), "Context");
        }();
        return made;
    }
    void build(std::span<const Mesh> meshes, uint32_t maxInstances = 64) {
        std::vector<restir::BvhMesh> built;
        for (const Mesh& mesh : meshes) built.push_back(mesh.build());
        bvh = std::make_unique<restir::Bvh>(device().require(
            restir::Bvh::create(context(), {.meshes = built, .maxInstances = maxInstances}), "Bvh"));
    }
    void place(const std::vector<restir::BvhInstance>& instances, uint32_t slot = 0) {
        device().submitAndWait(
            [&](VkCommandBuffer cmd) { device().check(bvh->record(cmd, slot, instances), "Bvh::record"); });
    }
    std::vector<RayHit> trace(const std::vector<RsLoggedRay>& rays, bool previous = false) {
        return samples::RayTracer(device(), scene, restir::RayBackend::Software, &*bvh).trace(rays, previous);
    }

    samples::GpuScene scene{device(), planeScene()};   // opaque: nobody asks it
    std::unique_ptr<restir::Bvh> bvh;
};

Mesh oneTriangle() {
    Mesh mesh;
    mesh.add({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    return mesh;
}

TEST_F(SoftwareRays, HitOneTriangleWhereItIs) {
    const Mesh mesh = oneTriangle();
    build({&mesh, 1});
    place({instanceOf(0, 77)});
    samples::build::Rng rng(1);
    std::vector<RsLoggedRay> rays;
    std::vector<glm::vec2> uvs;
    for (int i = 0; i < 4000; ++i) {
        uvs.emplace_back(1.2f * rng.uniform() - 0.1f, 1.2f * rng.uniform() - 0.1f);
        const glm::vec3 from{2 * rng.uniform() - 1, 2 * rng.uniform() - 1,
                             (i % 2 ? 1.0f : -1.0f) * (0.5f + rng.uniform())};
        rays.push_back(
            makeRay(from, 0.25f * (glm::vec3(uvs.back(), 0) - from), i % 4 < 2 ? 1e30f : kInfinity, true));
    }
    const std::vector<RayHit> hits = trace(rays);
    for (size_t i = 0; i < rays.size(); ++i) {
        const float edge = std::min({uvs[i].x, uvs[i].y, 1 - uvs[i].x - uvs[i].y});
        if (std::abs(edge) < 1e-5f) continue;
        ASSERT_EQ(hits[i].found(), edge > 0) << i;
        if (edge < 0) continue;
        ASSERT_NEAR(hits[i].t, 4, 1e-5);
        ASSERT_NEAR(hits[i].barycentrics[0], uvs[i].x, 1e-5);
        ASSERT_NEAR(hits[i].barycentrics[1], uvs[i].y, 1e-5);
        ASSERT_EQ(hits[i].record, 77u);
        ASSERT_EQ(hits[i].primitive, 0u);
    }
}

TEST_F(SoftwareRays, EndWhereTheyAreToldTo) {
    const Mesh mesh = oneTriangle();
    build({&mesh, 1});
    place({instanceOf(0, 0)});
    const glm::vec3 from{0.25f, 0.25f, 2}, down{0, 0, -1};
    const std::vector<RayHit> hits =
        trace({makeRay(from, down, 1.999f, true), makeRay(from, down, 2.001f, true),
               makeRay(from, down, 1.999f, false), makeRay(from, down, 2.001f, false),
               makeRay(from, -down, kInfinity, true), makeRay({0.25f, 0.25f, 0}, down, 1, true),
               makeRay(from, {0, 0, -1e-12f}, kInfinity, true), makeRay(from, 1e12f * down, 1, true)});
    const bool expected[] = {false, true, false, true, false, false, true, true};
    for (size_t i = 0; i < hits.size(); ++i) EXPECT_EQ(hits[i].found(), expected[i]) << i;
    EXPECT_NEAR(hits[6].t, 2e12f, 1e7f);
}

// Nothing to hit, or nothing that can be.
TEST_F(SoftwareRays, EmptyScenesAndBrokenTriangles) {
    const glm::vec3 from{0.25f, 0.25f, 2}, down{0, 0, -1};
    const std::vector<RsLoggedRay> rays = {makeRay(from, down, kInfinity, true),
                                           makeRay(from, down, kInfinity, false)};
    std::vector<Mesh> meshes(3);
    meshes[0].add({0, 0, 0}, {kNan, 0, 0}, {0, 1, 0});
    meshes[0].add({0, 0, 0}, {kInfinity, 0, 0}, {0, 1, 0});
    meshes[0].add({0, 0, 0}, {1, 1, 0}, {2, 2, 0});
    meshes[2] = oneTriangle();
    build(meshes, 8);
    const glm::mat4 flat{{1, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
    const std::vector<std::vector<restir::BvhInstance>> scenes = {{},
                                                                  {instanceOf(0, 0)},
                                                                  {instanceOf(0, 0), instanceOf(1, 0)},
                                                                  {instanceOf(2, 0, flat)},
                                                                  {instanceOf(2, 0, 1e30f * flat)}};
    for (size_t i = 0; i < scenes.size(); ++i) {
        place(scenes[i]);
        for (const RayHit& hit : trace(rays)) EXPECT_FALSE(hit.found()) << i;
    }
    place({instanceOf(0, 0), instanceOf(2, 5), instanceOf(1, 0)});
    for (const RayHit& hit : trace(rays)) EXPECT_TRUE(hit.found());
    EXPECT_EQ(trace(rays)[0].record, 5u);
    build({}, 0);
    place({});
    for (const RayHit& hit : trace(rays)) EXPECT_FALSE(hit.found());
}

TEST_F(SoftwareRays, ThatAreNoRaysHitNothing) {
    const Mesh mesh = oneTriangle();
    build({&mesh, 1});
    place({instanceOf(0, 0)});
    std::vector<RsLoggedRay> rays;
    for (float bad : {kNan, kInfinity, -kInfinity})
        for (bool closest : {false, true})
            for (int i = 0; i < 3; ++i) {
                glm::vec3 at{0.25f, 0.25f, 2}, direction{0, 0, -1};
                at[i] = bad;
                rays.push_back(makeRay(at, {0, 0, -1}, 10, closest));
                direction[i] = bad;
                rays.push_back(makeRay({0.25f, 0.25f, 2}, direction, 10, closest));
            }
    rays.push_back(makeRay({0.25f, 0.25f, 2}, {0, 0, 0}, 10, true));
    rays.push_back(makeRay({0.25f, 0.25f, 2}, {0, 0, -1}, kNan, true));
    rays.push_back(makeRay({0.25f, 0.25f, 2}, {0, 0, -1}, -1, true));
    for (const RayHit& hit : trace(rays)) EXPECT_FALSE(hit.found());
}

// Against every triangle in the world, in doubles.
TEST_F(SoftwareRays, InstancesTurnedScaledShearedAndMirrored) {
    samples::build::Rng rng(5);
    std::vector<Mesh> meshes(3);
    for (Mesh& mesh : meshes)
        for (int i = 0; i < 60; ++i) {
            const glm::vec3 at = 0.5f * rng.direction();
            mesh.add(at, at + 0.3f * rng.direction(), at + 0.3f * rng.direction());
        }
    build(meshes);
    std::vector<restir::BvhInstance> instances;
    std::vector<glm::dmat4> transforms;
    for (uint32_t i = 0; i < 24; ++i) {
        glm::mat4 m = samples::build::place(3.0f * rng.direction(), rng.range(0, 6), rng.range(0.3f, 1.5f));
        m[1] *= i % 3 == 0 ? -0.5f : 1.2f;   // mirrored
        m[2] += 0.4f * m[0];                 // sheared
        instances.push_back(instanceOf(i % 3, 1000 * i, m));
        transforms.emplace_back(m);
    }
    place(instances);
    std::vector<RsLoggedRay> rays;
    for (int i = 0; i < 3000; ++i)
        rays.push_back(makeRay(4.0f * rng.direction(), rng.direction(), 100, i % 3 != 0));
    const std::vector<RayHit> hits = trace(rays);
    size_t found = 0;
    for (size_t r = 0; r < rays.size(); ++r) {
        const glm::dvec3 o(rays[r].originTmax.x, rays[r].originTmax.y, rays[r].originTmax.z),
            d(rays[r].directionClosest.x, rays[r].directionClosest.y, rays[r].directionClosest.z);
        double nearest = 100;
        uint32_t record = 0, primitive = 0;
        for (uint32_t i = 0; i < instances.size(); ++i) {
            const Mesh& mesh = meshes[i % 3];
            for (uint32_t k = 0; k < mesh.indices.size(); k += 3) {
                const auto point = [&](uint32_t c) {
                    return glm::dvec3(transforms[i] * glm::dvec4(mesh.positions[mesh.indices[k + c]], 1));
                };
                const glm::dvec3 a = point(0);
                const glm::dmat3 system(point(1) - a, point(2) - a, -d);
                const glm::dvec3 x = glm::inverse(system) * (o - a);
                if (x.x < 0 || x.y < 0 || x.x + x.y > 1 || !(x.z > 0 && x.z < nearest)) continue;
                nearest = x.z;
                record = instances[i].record;
                primitive = k / 3;
            }
        }
        const bool hit = nearest < 100;
        found += hit ? 1 : 0;
        ASSERT_EQ(hits[r].found(), hit) << r;
        if (!hit || rays[r].directionClosest.w < 0.5f) continue;
        ASSERT_NEAR(hits[r].t, nearest, 1e-5 * nearest + 1e-5) << r;
        ASSERT_EQ(hits[r].record, record) << r;
        ASSERT_EQ(hits[r].primitive, primitive) << r;
    }
    EXPECT_GT(found, 250u);
}

// Rays from within, right at the edges and corners of a closed mesh.
TEST_F(SoftwareRays, SlipThroughNoEdge) {
    samples::Geometry sphere;
    samples::build::addSphere(sphere, {3, 1, -2}, {1, 2, 1}, 24, 16);
    for (glm::vec3& p : sphere.positions)
        p = glm::round(p * 4096.0f) / 4096.0f;   // the seam meets itself exactly
    const Mesh mesh{sphere.positions, sphere.indices};
    build({&mesh, 1});
    place({instanceOf(0, 0)});
    std::vector<RsLoggedRay> rays;
    samples::build::Rng rng(9);
    for (size_t i = 0; i < mesh.indices.size(); ++i) {
        const glm::vec3 a = mesh.positions[mesh.indices[i]],
                        b = mesh.positions[mesh.indices[i - i % 3 + (i + 1) % 3]];
        for (float share : {0.0f, 0.5f, rng.uniform(), rng.uniform()})
            for (const glm::vec3& from : {glm::vec3(3, 1, -2), glm::vec3(3.2f, 0.3f, -1.9f)})
                rays.push_back(makeRay(from, glm::mix(a, b, share) - from, kInfinity, true));
    }
    size_t atEdges = 0, atCorners = 0;
    const std::vector<RayHit> hits = trace(rays);
    for (size_t i = 0; i < hits.size(); ++i) (i % 8 < 2 ? atCorners : atEdges) += hits[i].found() ? 0 : 1;
    EXPECT_EQ(atEdges, 0u);
    EXPECT_LE(atCorners, rays.size() / 4 / 200);   // where six edges meet in rounding errors
}

TEST_F(SoftwareRays, LastFramesInstancesStay) {
    const Mesh mesh = oneTriangle();
    build({&mesh, 1});
    const std::vector<RsLoggedRay> rays = {makeRay({0.25f, 0.25f, 2}, {0, 0, -1}, 10, false),
                                           makeRay({5.25f, 0.25f, 2}, {0, 0, -1}, 10, false)};
    const auto at = [&](bool previous) {
        const std::vector<RayHit> hits = trace(rays, previous);
        return std::array{hits[0].found(), hits[1].found()};
    };
    place({instanceOf(0, 0)}, 0);
    place({instanceOf(0, 0, samples::build::place({5, 0, 0}))}, 1);
    EXPECT_EQ(at(false), (std::array{false, true}));
    EXPECT_EQ(at(true), (std::array{true, false}));
    place({}, 0);
    EXPECT_EQ(at(false), (std::array{false, false}));
    EXPECT_EQ(at(true), (std::array{false, true}));
}

}   // namespace
}   // namespace tests
