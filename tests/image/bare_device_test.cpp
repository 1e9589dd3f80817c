// Ray backends on a device that has been asked for what they need and no more: under validation, which would say so.
#include <gtest/gtest.h>

#include <cstring>
#include <numbers>

#include <common/acceleration.h>
#include <common/builtin.h>
#include <common/camera.h>
#include <common/gpu_memory.h>
#include <restir/restir.h>

#include "image/hypothesis.h"
#include "image/world.h"

namespace tests {
namespace {

constexpr VkExtent2D kExtent{48, 32};
constexpr float kHeight = 2;   // of the camera over the plane y = 0
constexpr glm::vec3 kLamp{0, 1, 0};
constexpr float kIntensity = 3, kAlbedo = 1;
constexpr float kEdge = 0.1f;   // of a wall at y = 0.5 towards +x

// A host without ray query: it makes its G-buffer of what it knows about the plane.
class BareHost {
public:
    explicit BareHost(restir::RayBackend rays)
        : rays_(rays),
          device_({.rays = rays == restir::RayBackend::Pipeline, .rayQuery = false, .validate = true}) {
        const restir::ContextDesc desc{.device = device_.sdkInfo(), .rays = rays};
        device_.check(restir::checkDevice(desc.device, desc.rays), "checkDevice");
        context_ = made(restir::Context::create(desc));
        const restir::gpu::RsInstance instance{.material = 0, .firstLight = RS_NO_LIGHT};
        const restir::gpu::RsMaterial material{};
        instances_ = storage(&instance, sizeof instance);
        materials_ = storage(&material, sizeof material);
        scene_ = made(restir::Scene::create(
            *context_, {.instances = instances_.handle(), .materials = materials_.handle()}));
        lights_ = made(restir::LightTable::create(*context_, {.maxLights = 1}));
        session_ = made(restir::Session::create(*context_, {.maxExtent = kExtent}));
        makeWall();
        samples::Uploader uploader(device_);
        depth_ = image(uploader, glm::vec4(kHeight));
        normal_ = image(uploader, {0, 1, 0, 0});
        color_ = image(uploader, glm::vec4(kAlbedo));
        material_ = image(uploader, {1, 0, 0, 0});   // rough, no metal, no specular
        uploader.flush();
        const VkDeviceSize bytes = VkDeviceSize{kExtent.width} * kExtent.height * sizeof(glm::vec4);
        target_ = samples::GpuImage(device_, kExtent, VK_FORMAT_R32G32B32A32_SFLOAT,
                                    VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT);
        readback_ = samples::Buffer(device_, {.size = bytes,
                                              .usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                              .memory = samples::MemoryKind::Readback});
    }

    samples::CameraPose pose() const {
        return samples::makePose(
            {.eye = {0, kHeight, 0}, .target = {0, 0, 0}, .up = {0, 0, -1}, .verticalFov = 0.8f}, kExtent);
    }

    std::span<const glm::vec4> frame() {
        const restir::Light lamp{.kind = restir::LightKind::Point,
                                 .position = {kLamp.x, kLamp.y, kLamp.z},
                                 .emission = {kIntensity, kIntensity, kIntensity}};
        device_.check(lights_->upload(0, {&lamp, 1}), "LightTable::upload");
        const restir::FrameInput input{.extent = kExtent,
                                       .camera = samples::sdkCamera(pose(), {0, 0}),
                                       .gbuffer = {.depth = {depth_.view()},
                                                   .normal = {normal_.view()},
                                                   .baseColor = {color_.view()},
                                                   .material = {material_.view()},
                                                   .normals = restir::NormalEncoding::Xyz,
                                                   .depthKind = restir::DepthKind::Linear,
                                                   .emptyDepth = -1},
                                       .tlas = structure_.top(),
                                       .bvh = bvh_ ? &*bvh_ : nullptr,
                                       .scene = &*scene_,
                                       .lights = &*lights_,
                                       .output = {.radiance = target_.view()}};
        device_.submitAndWait([&](VkCommandBuffer cmd) {
            const restir::BvhInstance wall{};
            device_.check(lights_->record(cmd, 0), "LightTable::record");
            if (bvh_) device_.check(bvh_->record(cmd, 0, {&wall, 1}), "Bvh::record");
            const restir::Scope scope = restir::Session::outputScope(rays_), in = restir::Session::inputScope(rays_);
            samples::memoryBarrier(cmd, {VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_MEMORY_WRITE_BIT},
                                   {in.stages, in.access});
            const samples::Access written{scope.stages, scope.access, VK_IMAGE_LAYOUT_GENERAL};
            const samples::Access copied{VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_READ_BIT,
                                         VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL};
            samples::pipelineBarrier(cmd, {{samples::imageBarrier(target_, {}, written)}});
            device_.check(session_->record(cmd, input, unbiased()), "Session::record");
            samples::pipelineBarrier(cmd, {{samples::imageBarrier(target_, written, copied)}});
            const VkBufferImageCopy region{.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                                           .imageExtent = {kExtent.width, kExtent.height, 1}};
            vkCmdCopyImageToBuffer(cmd, target_.handle(), copied.layout, readback_.handle(), 1, &region);
            samples::memoryBarrier(cmd, {VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT},
                                   {VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT});
        });
        return {reinterpret_cast<const glm::vec4*>(readback_.mapped()),
                size_t{kExtent.width} * kExtent.height};
    }
    samples::Device& vulkan() { return device_; }

private:
    template <class T>
    std::optional<T> made(restir::Result<T> result) {
        return device_.require(std::move(result), "restir");
    }
    samples::Buffer storage(const void* data, size_t bytes) {
        samples::Buffer buffer(device_, {.size = bytes,
                                         .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                                         .memory = samples::MemoryKind::Upload});
        std::memcpy(buffer.mapped(), data, bytes);
        return buffer;
    }
    samples::GpuImage image(samples::Uploader& uploader, glm::vec4 value) {
        samples::GpuImage made(device_, kExtent, VK_FORMAT_R32G32B32A32_SFLOAT,
                               VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT);
        const std::vector<glm::vec4> texels(size_t{kExtent.width} * kExtent.height, value);
        uploader.image(made, std::as_bytes(std::span(texels)));
        return made;
    }
    void makeWall() {
        const float positions[] = {kEdge, 0.5f, -9, kEdge, 0.5f, 9, 9, 0.5f, 9, 9, 0.5f, -9};
        const uint32_t indices[] = {0, 1, 2, 0, 2, 3};
        if (rays_ == restir::RayBackend::Pipeline) return makeStructure(positions, indices);
        const restir::BvhGeometry geometry{.positions = positions, .indices = indices};
        const restir::BvhMesh mesh =
            device_.require(restir::BvhMesh::create({.geometries = {&geometry, 1}}), "BvhMesh");
        bvh_ = made(restir::Bvh::create(*context_, {.meshes = {&mesh, 1}, .maxInstances = 1}));
    }

    void makeStructure(std::span<const float> positions, std::span<const uint32_t> indices) {
        constexpr VkBufferUsageFlags usage = VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_BUILD_INPUT_READ_ONLY_BIT_KHR |
                                             VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;
        const auto input = [&](const void* data, size_t bytes) {
            samples::Buffer buffer(device_, {.size = bytes, .usage = usage, .memory = samples::MemoryKind::Upload});
            std::memcpy(buffer.mapped(), data, bytes);
            return buffer;
        };
        const samples::Buffer corners = input(positions.data(), positions.size_bytes()),
                              triangles = input(indices.data(), indices.size_bytes());
        VkAccelerationStructureInstanceKHR wall{};
        wall.transform.matrix[0][0] = wall.transform.matrix[1][1] = wall.transform.matrix[2][2] = 1;
        wall.mask = 0xff;
        wall.instanceShaderBindingTableRecordOffset = 7;   // of pipelines that the SDK knows nothing of
        structure_ = samples::Acceleration(device_,
                                           {{{.positions = corners.address(),
                                              .indices = triangles.address(),
                                              .vertexCount = 4,
                                              .triangleCount = 2}}},
                                           {wall});
    }

    restir::RayBackend rays_;
    samples::Device device_;
    std::optional<restir::Context> context_;
    samples::Buffer instances_, materials_, readback_;
    samples::GpuImage depth_, normal_, color_, material_, target_;
    std::optional<restir::Scene> scene_;
    std::optional<restir::LightTable> lights_;
    std::optional<restir::Bvh> bvh_;
    samples::Acceleration structure_;
    std::optional<restir::Session> session_;
};

void expectShadow(restir::RayBackend rays) {
    BareHost host(rays);
    const std::span<const glm::vec4> picture = host.frame();
    const samples::CameraPose pose = host.pose();
    size_t lit = 0, dark = 0;
    for (uint32_t y = 0; y < kExtent.height; ++y)
        for (uint32_t x = 0; x < kExtent.width; ++x) {
            const glm::vec2 ndc =
                2.0f * (glm::vec2(x, y) + 0.5f) / glm::vec2(kExtent.width, kExtent.height) - 1.0f;
            const glm::vec3 point =
                pose.eye + kHeight * (pose.forward + ndc.x * pose.right - ndc.y * pose.up);
            if (std::abs(point.x - 2 * kEdge) < 0.01f) continue;   // the edge of the shadow
            const bool shadow = point.x > 2 * kEdge;
            const glm::vec3 way = kLamp - point;
            const float square = dot(way, way);
            const float expected = shadow ? 0
                                          : kIntensity * kAlbedo / std::numbers::pi_v<float> * way.y /
                                                (square * std::sqrt(square));
            EXPECT_NEAR(picture[y * kExtent.width + x].x, expected, 1e-3f * expected) << x << ", " << y;
            ++(shadow ? dark : lit);
        }
    EXPECT_GT(lit, 200u);
    EXPECT_GT(dark, 200u);
    EXPECT_EQ(host.vulkan().validationMessages(), 0u);
}

TEST(BareDevice, ShadowOfAWallWithoutRayTracing) { expectShadow(restir::RayBackend::Software); }

TEST(BareDevice, ShadowOfAWallWithoutRayQuery) {
    if (!device().hasRayPipelines()) GTEST_SKIP() << "no ray tracing pipelines";
    expectShadow(restir::RayBackend::Pipeline);
}

// The samples' own passes trace by ray tracing pipelines where there is no ray query: the same random numbers, the same
// triangles.
TEST(BareDevice, SamplesWithoutRayQuery) {
    if (!device().hasRayQuery() || !device().hasRayPipelines()) GTEST_SKIP() << "not both on this device";
    constexpr VkExtent2D extent{40, 24};
    samples::Device bare({.rayQuery = false, .validate = true});
    EXPECT_EQ(bare.bestRays(), restir::RayBackend::Pipeline);
    const samples::SceneData data = samples::makeBuiltin("market");   // alpha-tested leaves in it
    samples::FloatImage lit[2], references[2];
    for (samples::Device* each : {&device(), &bare}) {
        samples::GpuScene scene(*each, data);
        const samples::Sequence sequence{.view = data.views[0], .frames = 2, .seed = 7};
        lit[each == &bare] = samples::Renderer(*each, scene, extent).render(sequence, unbiased());
        references[each == &bare] = samples::Reference(*each, scene, extent).render(sequence, {.paths = 4, .bounces = 3});
    }
    EXPECT_GT(largest(lit[0]), 0.1f);
    EXPECT_LE(otherPixels(lit[1], lit[0]), 10u);   // rays that graze an edge
    EXPECT_LE(otherPixels(references[1], references[0]), 10u);
    EXPECT_EQ(bare.validationMessages(), 0u);
}

}   // namespace
}   // namespace tests
