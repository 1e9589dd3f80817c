// Lights that LightTable makes of a scene's triangles, on the device.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>

#include "common/gpu_scene.h"
#include "common/mesh_builder.h"
#include "gpu/built_table.h"
#include "support/gpu.h"

namespace {

using restir::Light;
using restir::LightMesh;
using restir::gpu::RsInstance;
using restir::gpu::RsMaterial;
using restir::gpu::RsPackedLight;
using samples::Buffer;
using tests::BuiltTable;
using tests::MeshTable;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN(),
                kInfinity = std::numeric_limits<float>::infinity();

class MeshLights : public tests::GpuTest {};

uint32_t kindOf(const RsPackedLight& light) { return light.kindAndTexture & RS_LIGHT_KIND_MASK; }
glm::vec3 toGlm(const restir::gpu::vec3& v) { return {v.x, v.y, v.z}; }

// A vector that shaders and the CPU share.
template <class T>
class Shared {
public:
    explicit Shared(size_t count)
        : buffer_(tests::gpu(),
                  {.size = count * sizeof(T),
                   .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT,
                   .memory = samples::MemoryKind::Upload}) {
        for (size_t i = 0; i < count; ++i) (*this)[i] = T{};
    }
    T& operator[](size_t i) { return reinterpret_cast<T*>(buffer_.mapped())[i]; }
    VkBuffer handle() const { return buffer_.handle(); }
    VkDeviceAddress address() const { return buffer_.address(); }

private:
    Buffer buffer_;
};

// Textures as GpuScene makes them.
std::unique_ptr<samples::GpuScene> texturesOf(const std::vector<samples::Image>& images) {
    samples::SceneData scene;
    for (const samples::Image& image : images) samples::build::addTexture(scene, image);
    samples::Geometry geometry{.material = samples::build::addMaterial(scene, {})};
    samples::build::addTriangle(geometry, {glm::vec3(0), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0)});
    samples::build::addInstance(scene, samples::build::addMesh(scene, {geometry}));
    return std::make_unique<samples::GpuScene>(tests::gpu(), std::move(scene));
}

// Triangles of one record, whose data the test changes at will.
struct Field {
    explicit Field(uint32_t triangles, const std::vector<samples::Image>& images = {})
        : count(triangles),
          corners(3 * triangles),
          uvs(3 * triangles),
          indices(3 * triangles),
          records(1),
          materials(1),
          textures(texturesOf(images)) {
        for (uint32_t i = 0; i < 3 * triangles; ++i) indices[i] = i;
        records[0] = {.positions = corners.address(),
                      .indices = indices.address(),
                      .uvs = uvs.address(),
                      .worldFromObject = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
        materials[0] = {.emission = {1, 1, 1}, .emissionTexture = RS_NO_TEXTURE};
        for (uint32_t i = 0; i < triangles; ++i) set(i, glm::vec3(0), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0));
    }
    void set(uint32_t triangle, glm::vec3 a, glm::vec3 b, glm::vec3 c) {
        corners[3 * triangle] = a;
        corners[3 * triangle + 1] = b;
        corners[3 * triangle + 2] = c;
    }
    void setUvs(uint32_t triangle, glm::vec2 a, glm::vec2 b, glm::vec2 c) {
        uvs[3 * triangle] = a;
        uvs[3 * triangle + 1] = b;
        uvs[3 * triangle + 2] = c;
    }
    restir::SceneDesc scene() const {
        return {
            .instances = records.handle(), .materials = materials.handle(), .textures = textures->textures()};
    }
    // All triangles, their ids from `first` on.
    std::unique_ptr<MeshTable> table(uint32_t first = 0, uint32_t more = 0) {
        auto made = std::make_unique<MeshTable>(
            scene(), restir::LightTableDesc{
                         .maxLights = first + count + more, .meshLights = first + count, .maxMeshes = 1});
        const LightMesh mesh{.record = 0, .firstLight = first, .triangles = count};
        tests::gpu().check(made->table().uploadMeshes(0, {&mesh, 1}), "uploadMeshes");
        return made;
    }

    uint32_t count;
    Shared<glm::vec3> corners;
    Shared<glm::vec2> uvs;
    Shared<uint32_t> indices;
    Shared<RsInstance> records;
    Shared<RsMaterial> materials;
    std::unique_ptr<samples::GpuScene> textures;
};

// Of lights whose weights are to each other as these.
void expectShares(const BuiltTable& table, const std::vector<double>& weights, double error = 1e-5) {
    double total = 0;
    for (double weight : weights) total += weight;
    total = std::max(total, 1e-30);
    ASSERT_GE(table.lights.size(), weights.size());
    for (size_t i = 0; i < weights.size(); ++i) {
        EXPECT_NEAR(double(table.lights[i].selection), weights[i] / total, error) << "light " << i;
        EXPECT_EQ(table.lights[i].selection > 0, weights[i] > 0) << "light " << i;
        EXPECT_EQ(kindOf(table.lights[i]), weights[i] > 0 ? RS_LIGHT_TRIANGLE : RS_LIGHT_NONE)
            << "light " << i;
    }
}

BuiltTable tableOf(const samples::GpuScene& scene, restir::LightTableDesc desc) {
    desc.maxLights = scene.maxLights();
    MeshTable table(
        {.instances = scene.instances(), .materials = scene.materials(), .textures = scene.textures()}, desc);
    if (desc.meshLights > 0)
        tests::gpu().check(table.table().uploadMeshes(0, scene.lightMeshes()), "uploadMeshes");
    tests::gpu().check(table.table().upload(0, scene.lights(desc.meshLights)), "upload");
    return table.build();
}

// The same lights as those that a host makes and uploads; textures' means are its own, but of the same sign.
TEST_F(MeshLights, AreThoseOfAHost) {
    const samples::GpuScene scene(tests::gpu(), samples::makeBuiltin("market"));
    const BuiltTable host = tableOf(scene, {});
    const BuiltTable device =
        tableOf(scene, {.meshLights = scene.meshLights(), .maxMeshes = uint32_t(scene.lightMeshes().size())});
    ASSERT_EQ(host.lights.size(), device.lights.size());
    double difference = 0;
    uint32_t textured = 0;
    for (size_t i = 0; i < host.lights.size(); ++i) {
        const RsPackedLight &a = host.lights[i], &b = device.lights[i];
        ASSERT_EQ(a.kindAndTexture, b.kindAndTexture) << "light " << i;
        const double scale = 1e-6 * (1 + double(glm::length(toGlm(a.position))));
        ASSERT_LE(double(glm::distance(toGlm(a.position), toGlm(b.position))), scale);
        ASSERT_LE(double(glm::distance(toGlm(a.edge1), toGlm(b.edge1))), scale);
        ASSERT_LE(double(glm::distance(toGlm(a.edge2), toGlm(b.edge2))), scale);
        ASSERT_EQ(std::memcmp(&a.emission, &b.emission, sizeof a.emission), 0);
        ASSERT_EQ(std::memcmp(&a.uv0, &b.uv0, 3 * sizeof a.uv0), 0) << "light " << i;
        ASSERT_EQ(a.selection > 0, b.selection > 0) << "light " << i;
        difference += 0.5 * std::abs(double(a.selection) - double(b.selection));
        textured += kindOf(a) == RS_LIGHT_TRIANGLE &&
                    a.kindAndTexture >> RS_LIGHT_TEXTURE_SHIFT != RS_LIGHT_NO_TEXTURE;
    }
    EXPECT_GT(textured, 100u);
    EXPECT_LT(difference, 0.01) << "of all draws";
}

TEST_F(MeshLights, FollowTheirVertices) {
    Field field(1500);
    samples::build::Rng rng(3);
    const auto table = field.table();
    for (int frame = 0; frame < 3; ++frame) {
        std::vector<double> areas;
        for (uint32_t i = 0; i < field.count; ++i) {
            const glm::vec3 a = 10.0f * rng.direction(), u = rng.range(0, 2) * rng.direction(),
                            v = rng.direction();
            field.set(i, a, a + u, a + v);
            areas.push_back(double(glm::length(glm::cross((a + u) - a, (a + v) - a))));
        }
        const BuiltTable built = table->build();
        expectShares(built, areas);
        for (uint32_t i = 0; i < field.count; ++i)
            EXPECT_EQ(toGlm(built.lights[i].position), field.corners[3 * i]) << "light " << i;
    }
}

TEST_F(MeshLights, FollowTransformsAndMaterials) {
    Field field(2);
    field.set(1, {0, 0, 0}, {3, 0, 0}, {0, 1, 0});
    const auto table = field.table();
    expectShares(table->build(), {1, 3});
    field.records[0].worldFromObject[0] = {0, -2, 0, 5};   // a quarter turn, twice as large, beside it
    field.records[0].worldFromObject[1] = {2, 0, 0, 6};
    field.records[0].worldFromObject[2] = {0, 0, 2, 7};
    field.materials[0].flags = RS_MATERIAL_DOUBLE_SIDED;
    field.materials[0].emission = {0.5f, 0, 8};
    const BuiltTable turned = table->build();
    expectShares(turned, {1, 3});
    EXPECT_EQ(toGlm(turned.lights[1].position), glm::vec3(5, 6, 7));
    EXPECT_EQ(toGlm(turned.lights[1].edge1), glm::vec3(0, 6, 0));
    EXPECT_EQ(toGlm(turned.lights[1].edge2), glm::vec3(-2, 0, 0));
    EXPECT_EQ(toGlm(turned.lights[1].emission), glm::vec3(0.5f, 0, 8));
    EXPECT_EQ(turned.lights[1].kindAndTexture & RS_LIGHT_TWO_SIDED, RS_LIGHT_TWO_SIDED);
    for (float black : {0.0f, -1.0f, kNan}) {
        field.materials[0].emission = {black, 0, 0};
        expectShares(table->build(), {0, 0});
    }
    for (float bright : {kInfinity, 3e38f}) {
        field.materials[0].emission = {bright, kNan, -3};
        const BuiltTable built = table->build();
        expectShares(built, {1, 3});
        EXPECT_EQ(toGlm(built.lights[0].emission), glm::vec3(1e30f, 0, 0));
    }
}

TEST_F(MeshLights, WhatHasNoAreaIsNoLight) {
    Field field(8);
    const glm::vec3 a(1, 2, 3), b(2, 2, 3);
    field.set(1, a, b, b);
    field.set(2, a, a, a);
    field.set(3, a, b, a + 2.0f * (b - a));
    field.set(4, a, {kNan, 0, 0}, b);
    field.set(5, a, b, {0, kInfinity, 0});
    field.set(6, {0, -kInfinity, 0}, b, {0, 4, 0});
    field.set(7, {0, 0, 0}, {2e9f, 0, 0}, {0, 1, 0});
    expectShares(field.table()->build(), {1, 0, 0, 0, 0, 0, 0, 0});
}

// Uploaded ones stay while meshes are read anew, gaps are empty, and meshes go.
TEST_F(MeshLights, BesideUploadedOnes) {
    Field field(3);
    const auto table = field.table(2, 3);   // ids 2, 3 and 4; then 5, 6 and 7
    std::vector<Light> bulbs(2, Light{.kind = restir::LightKind::Point, .emission = {0.25f, 0.25f, 0.25f}});
    bulbs[0].id = 7;
    bulbs[1].id = 5;
    tests::gpu().check(table->table().upload(0, bulbs), "upload");
    const double bulb = 0.25 * 4, triangle = 0.5;   // times pi
    for (int frame = 0; frame < 3; ++frame) {
        const BuiltTable built = table->build();
        const double sum = 2 * bulb + 3 * triangle;
        const double wanted[] = {0, 0, triangle, triangle, triangle, bulb, 0, bulb};
        for (size_t i = 0; i < 8; ++i)
            EXPECT_NEAR(double(built.lights[i].selection), wanted[i] / sum, 1e-6) << i;
        EXPECT_EQ(kindOf(built.lights[1]), RS_LIGHT_NONE);
        EXPECT_EQ(kindOf(built.lights[6]), RS_LIGHT_NONE);
        EXPECT_EQ(kindOf(built.lights[7]), RS_LIGHT_POINT);
    }
    for (int frame = 0; frame < 2; ++frame) {   // into either generation
        tests::gpu().check(table->table().uploadMeshes(0, {}), "uploadMeshes");
        const BuiltTable without = table->build();
        for (size_t i = 0; i < 8; ++i) {
            EXPECT_EQ(kindOf(without.lights[i]), i == 5 || i == 7 ? RS_LIGHT_POINT : RS_LIGHT_NONE) << i;
            EXPECT_NEAR(double(without.lights[i].selection), i == 5 || i == 7 ? 0.5 : 0, 1e-6) << i;
        }
    }
    Light low = bulbs[0];
    low.id = 4;
    EXPECT_EQ(table->table().upload(0, {&low, 1}), restir::Status::InvalidArgument);
    EXPECT_NE(tests::gpu().sdkError().find("meshLights"), std::string::npos) << tests::gpu().sdkError();
}

// ---- textures --------------------------------------------------------------------------------------

constexpr uint32_t kTexels = 16;

// A ramp in u, linear light from 0 to 1.
samples::Image ramp() {
    return samples::build::paint(kTexels, kTexels, false,
                                 [](glm::vec2 uv) { return glm::vec4(uv.x, uv.x, uv.x, 1); });
}
samples::Image oneTexel(uint32_t column, uint32_t row) {
    samples::Image image{kTexels, kTexels, std::vector<uint8_t>(4 * kTexels * kTexels), false};
    for (int c = 0; c < 4; ++c) image.rgba[4 * (row * kTexels + column) + size_t(c)] = 255;
    return image;
}

TEST_F(MeshLights, WeighTheirTextures) {
    Field field(5, {ramp()});
    field.materials[0].emissionTexture = 0;
    field.setUvs(0, {0.1f, 0}, {0.4f, 0}, {0.1f, 1});   // mean of u: 0.2
    field.setUvs(1, {0.6f, 0}, {0.9f, 0}, {0.9f, 1});   // 0.8
    field.setUvs(2, {0.75f, 0.5f}, {0.75f, 0.5f}, {0.75f, 0.5f});
    field.setUvs(3, {0, 0}, {9, 0}, {0, 7});   // repeats it all
    field.setUvs(4, {kNan, 0}, {kInfinity, 0}, {3e38f, 0});
    expectShares(field.table()->build(), {0.2, 0.8, 0.75, 0.5, 0.5}, 0.003);
}

TEST_F(MeshLights, BlackTexturesAreNoLights) {
    Field field(4, {oneTexel(5, 9)});
    field.materials[0].emissionTexture = 0;
    const auto uv = [](float x, float y) { return glm::vec2(x, y) / float(kTexels); };
    // The texel's light reaches from 4.5 to 6.5 and from 8.5 to 10.5.
    field.setUvs(0, uv(1, 1), uv(4.4f, 1), uv(1, 15));
    field.setUvs(1, uv(4.6f, 9.5f), uv(2, 9.5f), uv(2, 9));         // touches it
    field.setUvs(2, uv(0, 0), uv(16, 0), uv(0, 16));                // it is among many
    field.setUvs(3, uv(5.5f, 26), uv(5.6f, 26), uv(5.5f, 25.9f));   // once more around
    const BuiltTable built = field.table()->build();
    EXPECT_EQ(kindOf(built.lights[0]), RS_LIGHT_NONE);
    for (uint32_t i = 1; i < 4; ++i) EXPECT_GT(built.lights[i].selection, 0) << "light " << i;
    EXPECT_GT(built.lights[3].selection, 20 * built.lights[2].selection);
}

// What a texture shows is weighed once, and again with the next uploadMeshes().
TEST_F(MeshLights, TexturesAreWeighedAtAnUpload) {
    Field field(2, {ramp()});
    field.materials[0].emissionTexture = 0;
    const auto right = [&](uint32_t i) { field.setUvs(i, {0.75f, 0}, {0.75f, 1}, {0.75f, 0.5f}); };
    const auto left = [&](uint32_t i) { field.setUvs(i, {0.25f, 0}, {0.25f, 1}, {0.25f, 0.5f}); };
    left(0);
    right(1);
    const auto table = field.table();
    expectShares(table->build(), {1, 3}, 0.001);
    right(0);
    expectShares(table->build(), {1, 3}, 0.001);
    field.materials[0].emission = {7, 7, 7};
    expectShares(table->build(), {1, 3}, 0.001);
    const LightMesh mesh{.record = 0, .firstLight = 0, .triangles = 2};
    tests::gpu().check(table->table().uploadMeshes(0, {&mesh, 1}), "uploadMeshes");
    expectShares(table->build(), {1, 1}, 0.001);
}

TEST_F(MeshLights, SameMeshesSameBits) {
    Field field(3000, {ramp()});
    samples::build::Rng rng(5);
    field.materials[0].emissionTexture = 0;
    for (uint32_t i = 0; i < 3 * field.count; ++i) {
        field.corners[i] = rng.direction();
        field.uvs[i] = {rng.uniform(), rng.uniform()};
    }
    const BuiltTable first = field.table()->build();
    const auto table = field.table();
    for (int i = 0; i < 3; ++i) {
        const BuiltTable again = table->build();
        EXPECT_EQ(std::memcmp(first.lights.data(), again.lights.data(),
                              first.lights.size() * sizeof first.lights[0]),
                  0);
        EXPECT_EQ(
            std::memcmp(first.alias.data(), again.alias.data(), first.alias.size() * sizeof first.alias[0]),
            0);
    }
}

// ---- refusals --------------------------------------------------------------------------------------

TEST_F(MeshLights, RefusalsNameTheField) {
    Field field(4);
    const auto table = field.table();
    const auto expectRefusal = [](restir::Status status, const char* named) {
        EXPECT_EQ(status, restir::Status::InvalidArgument);
        EXPECT_NE(tests::gpu().sdkError().find(named), std::string::npos) << tests::gpu().sdkError();
    };
    const auto upload = [&](std::vector<LightMesh> meshes) { return table->table().uploadMeshes(0, meshes); };
    expectRefusal(table->table().uploadMeshes(7, {}), "frameSlot");
    expectRefusal(upload({{0, 0, 1}, {0, 1, 1}}), "maxMeshes");
    expectRefusal(upload({{0, 0, 0}}), "triangles");
    expectRefusal(upload({{0, 1, 4}}), "meshLights");
    expectRefusal(upload({{0, 0xffffffffu, 2}}), "meshLights");
    tests::gpu().submitAndWait([&](VkCommandBuffer cmd) {
        expectRefusal(table->table().record(cmd, 1, &table->scene()), "the upload went to 0");
        expectRefusal(table->table().record(cmd, 0), "scene is null");
        expectRefusal(table->table().record(cmd, 9, &table->scene()), "frameSlot");
    });
    expectShares(table->build(), {1, 1, 1, 1});   // the first list
    MeshTable two(field.scene(), {.maxLights = 8, .meshLights = 8, .maxMeshes = 2});
    const LightMesh overlapping[] = {{1, 4, 4}, {0, 0, 5}};
    expectRefusal(two.table().uploadMeshes(0, overlapping),
                  "mesh 0 (record 1): firstLight 4 is a light of mesh 1");
}

}   // namespace
