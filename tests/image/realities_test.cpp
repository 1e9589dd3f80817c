// What engines do that samples do not: other cameras, secondary command buffers, resizes in every frame,
// worlds far from the origin, light far from 1.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "image/host_view.h"
#include "image/hypothesis.h"
#include "image/stage.h"
#include "image/world.h"

namespace tests {
namespace {

constexpr VkExtent2D kExtent{32, 24};
constexpr glm::vec3 kLamp{0.3f, 1, 0};

// A plane under a point light: one candidate, nothing random.
class Realities : public testing::Test {
protected:
    Realities() { build(glm::vec3(0)); }

    // The plane, its camera and its light, moved by `offset`.
    void build(glm::vec3 offset) {
        samples::SceneData data = planeScene();
        for (auto& instance : data.instances) instance.worldFromObject = samples::build::place(offset);
        view = data.views[0];
        view.eye += offset;
        view.target += offset;
        host.reset();
        scene = std::make_unique<samples::GpuScene>(device(), std::move(data));
        host = std::make_unique<HostView>(*scene, view, HostDesc{.maxExtent = kExtent, .maxLights = 1});
        light(offset, 1);
    }
    void light(glm::vec3 offset, float intensity) {
        const glm::vec3 at = kLamp + offset;
        const restir::Light lamp{.kind = restir::LightKind::Point,
                                 .position = {at.x, at.y, at.z},
                                 .emission = {intensity, intensity, intensity}};
        host->upload({&lamp, 1});
    }
    samples::FloatImage picture(const std::function<void(restir::FrameInput&)>& change = {}) {
        samples::FloatImage image;
        for (uint32_t i = 0; i < 3; ++i) {
            restir::FrameInput input = host->input(i);
            input.resetHistory = i == 0;
            if (change) change(input);
            image = host->frame(input, unbiased());
        }
        EXPECT_TRUE(allFinite(image));
        return image;
    }

    samples::View view;
    std::unique_ptr<samples::GpuScene> scene;
    std::unique_ptr<HostView> host;
};

// View space looks along +z, and clip.w is z.
TEST_F(Realities, LeftHandedView) {
    const samples::FloatImage expected = picture();
    const samples::FloatImage image = picture([](restir::FrameInput& input) {
        for (int column = 0; column < 4; ++column) {
            input.camera.viewFromWorld.m[4 * column + 2] *= -1;
            input.camera.clipFromView.m[8 + column] *= -1;
        }
    });
    EXPECT_GT(largest(expected), 0);
    EXPECT_LE(largestDifference(image, expected), 1e-6);
}

TEST_F(Realities, OrthographicFromAbove) {
    constexpr float kHeight = 5, kHalf = 2;
    const size_t pixels = size_t{kExtent.width} * kExtent.height;
    const samples::GpuImage depth = floatImage(kExtent, std::vector(pixels, glm::vec4(kHeight)));
    const samples::GpuImage normal = floatImage(kExtent, std::vector(pixels, glm::vec4(0, 1, 0, 0)));
    const samples::GpuImage color = floatImage(kExtent, std::vector(pixels, glm::vec4(kAlbedo, 0)));
    const samples::GpuImage material = floatImage(kExtent, std::vector(pixels, glm::vec4(1, 0, 0, 0)));
    const samples::FloatImage image = picture([&](restir::FrameInput& input) {
        // x to the right, -z up, down the y axis.
        input.camera.viewFromWorld = {.m = {1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0, -kHeight, 1}};
        input.camera.clipFromView = {
            .m = {1 / kHalf, 0, 0, 0, 0, -1 / kHalf, 0, 0, 0, 0, -0.01f, 0, 0, 0, 0, 1}};
        input.gbuffer = {.depth = {depth.view()},
                         .normal = {normal.view()},
                         .baseColor = {color.view()},
                         .material = {material.view()},
                         .normals = restir::NormalEncoding::Xyz,
                         .depthKind = restir::DepthKind::Linear,
                         .emptyDepth = 0};
    });
    for (size_t i = 0; i < pixels; ++i) {
        const glm::dvec2 ndc = (glm::dvec2(i % kExtent.width, i / kExtent.width) + 0.5) * 2.0 /
                                   glm::dvec2(kExtent.width, kExtent.height) -
                               1.0;
        const glm::dvec3 to = glm::dvec3(kLamp) - glm::dvec3(ndc.x * kHalf, 0, ndc.y * kHalf);
        const double irradiance = to.y / std::pow(glm::dot(to, to), 1.5);
        for (int c = 0; c < 3; ++c) {
            const double expected = irradiance * double(kAlbedo[c]) / std::numbers::pi;
            ASSERT_NEAR(image.rgb[3 * i + size_t(c)], expected, 2e-3 * expected) << i;
        }
    }
}

// Powers of two change no digit.
TEST_F(Realities, BrightAndDarkLight) {
    const samples::FloatImage expected = picture();
    for (float power : {0x1p-90f, 0x1p90f}) {
        light(glm::vec3(0), power);
        samples::FloatImage image = picture();
        for (float& value : image.rgb) value /= power;
        EXPECT_LE(largestDifference(image, expected), 1e-4) << power;
    }
    for (float power : {1e-44f, 1e-38f, 1e30f}) {   // denormal, the smallest that is not, huge
        SCOPED_TRACE(power);
        light(glm::vec3(0), power);
        picture();
    }
}

// Rays start off a surface by 4e-5 of its coordinates, and light is reckoned from there: that of a lamp a
// metre away is wrong by so much. Hosts with large worlds hand over coordinates relative to the camera.
TEST_F(Realities, FarFromTheOrigin) {
    const samples::FloatImage expected = picture();
    const std::pair<float, double> limits[] = {{10, 2e-3}, {100, 0.02}, {1000, 0.2}};
    for (auto [metres, limit] : limits) {
        build({metres, 0, metres});
        const double difference = largestDifference(picture(), expected);
        std::printf("%9.0f m from the origin: off by %.2f %%\n", double(metres), 100 * difference);
        EXPECT_LE(difference, limit) << metres;
    }
}

TEST_F(Realities, SecondaryCommandBuffers) {
    const samples::FloatImage expected = picture();
    const VkCommandPoolCreateInfo poolInfo{.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                           .queueFamilyIndex = device().queueFamily()};
    VkCommandPool pool = VK_NULL_HANDLE;
    samples::check(vkCreateCommandPool(device().handle(), &poolInfo, nullptr, &pool), "vkCreateCommandPool");
    const VkCommandBufferAllocateInfo info{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                           .commandPool = pool,
                                           .level = VK_COMMAND_BUFFER_LEVEL_SECONDARY,
                                           .commandBufferCount = 3};
    VkCommandBuffer secondary[3];
    samples::check(vkAllocateCommandBuffers(device().handle(), &info, secondary), "vkAllocateCommandBuffers");
    for (uint32_t i = 0; i < 3; ++i) {
        const VkCommandBufferInheritanceInfo inherited{.sType =
                                                           VK_STRUCTURE_TYPE_COMMAND_BUFFER_INHERITANCE_INFO};
        const VkCommandBufferBeginInfo begin{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                             .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT,
                                             .pInheritanceInfo = &inherited};
        samples::check(vkBeginCommandBuffer(secondary[i], &begin), "vkBeginCommandBuffer");
        restir::FrameInput input = host->input(i);
        input.resetHistory = i == 0;
        host->record(secondary[i], input, unbiased());
        samples::check(vkEndCommandBuffer(secondary[i]), "vkEndCommandBuffer");
    }
    device().submitAndWait([&](VkCommandBuffer cmd) { vkCmdExecuteCommands(cmd, 3, secondary); });
    EXPECT_EQ(host->read(2).rgb, expected.rgb);
    EXPECT_FALSE(host->session().timings(2).empty());
    vkDestroyCommandPool(device().handle(), pool, nullptr);
}

// Dynamic resolution: every frame has another extent, and looks like one without history.
TEST_F(Realities, ResizeInEveryFrame) {
    for (uint32_t i = 0; i < 8; ++i) {
        host->resize({kExtent.width - 3 * (i * 5 % 7), kExtent.height - 2 * (i * 3 % 5)});
        const samples::FloatImage image = host->frame(host->input(i), unbiased());
        restir::FrameInput fresh = host->input(i);
        fresh.resetHistory = true;
        EXPECT_LE(largestDifference(image, host->frame(fresh, unbiased())), 1e-4) << i;
        host->frame(host->input(i), unbiased());
    }
}

}   // namespace
}   // namespace tests
