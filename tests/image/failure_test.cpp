// Every Vulkan call that the SDK makes and that can fail does so, one by one: it is said, nothing is left
// behind, and a second try gives the same picture.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <map>
#include <optional>

#include "image/faults.h"
#include "image/host_view.h"
#include "image/stage.h"
#include "image/world.h"

namespace tests {
namespace {

using restir::Status;

constexpr VkExtent2D kExtent{16, 12}, kSmaller{8, 8};
constexpr const char* kCounted = "the calls counted here are those with ray query";

// What a message must name when a call fails.
const std::map<std::string, const char*> kNamed = {
    {"vkAllocateMemory", "bytes"},
    {"vkMapMemory", "bytes"},
    {"vkCreateBuffer", "buffer"},
    {"vkBindBufferMemory", "buffer"},
    {"vkCreateShaderModule", "pipeline of"},
    {"vkCreateDescriptorSetLayout", "set layout"},
    {"vkCreatePipelineLayout", "pipeline layout"},
    {"vkCreateComputePipelines", "pipeline of"},
    {"vkCreateRayTracingPipelinesKHR", "pipeline of"},
    {"vkGetRayTracingShaderGroupHandlesKHR", "shader group"},
    {"vkCreateDescriptorPool", "descriptor set"},
    {"vkAllocateDescriptorSets", "descriptor set"},
    {"vkCreateQueryPool", "query pool"},
    {"vkGetQueryPoolResults", "timestamps"},
};

constexpr size_t kOfRayPipelines = 2;

Status expectedStatus(VkResult result) {
    if (result == VK_ERROR_OUT_OF_HOST_MEMORY) return Status::OutOfHostMemory;
    return result == VK_ERROR_OUT_OF_DEVICE_MEMORY ? Status::OutOfDeviceMemory : Status::DeviceError;
}

class Failure : public testing::Test {
protected:
    Failure() {
        samples::SceneData data = planeScene();
        addQuad(data, lamp({0, 1, 0}, 0.5f), {.emission = {1, 1, 1}});
        const samples::View view = data.views[0];
        scene = std::make_unique<samples::GpuScene>(device(), std::move(data));
        host = std::make_unique<HostView>(*scene, view, HostDesc{.maxExtent = kExtent});
        desc = HostView::contextDesc();
        desc.pipelines = restir::PipelineCreation::All;
        desc.device = faults::wrap(desc.device);
        desc.device.messages = {.user = this, .report = [](void* user, restir::Severity, const char* text) {
                                    static_cast<Failure*>(user)->messages += std::string(text) + "\n";
                                }};
        faults::reset();
    }

    // What `make` gives, at the second try where the first one runs into the fault and there is another.
    template <class Make>
    auto made(Make make, int tries = 2) -> decltype(make()) {
        const std::string before = faults::live();
        messages.clear();
        auto result = make();
        if (result) return result;
        ++refusals;
        if (faults::live() != before) ++leaks;
        const restir::Error& error = result.error();
        const bool named = messages.find(kNamed.at(faults::failed())) != std::string::npos;
        if (error.status != expectedStatus(fault) || error.vk != fault || !*error.what || !named) {
            ++wrong;
            ADD_FAILURE() << faults::failed() << ": status " << int(error.status) << ", " << error.what
                          << ", " << messages;
        }
        return tries > 1 ? make() : std::move(result);
    }

    // What rays are traced in where the context asks for it.
    std::optional<restir::Bvh> madeBvh(const restir::Context& context) {
        const std::vector<restir::BvhMesh> meshes = scene->makeBvhMeshes();
        auto bvh = made([&] { return restir::Bvh::create(context, {.meshes = meshes, .maxInstances = 2}); });
        return bvh ? std::optional(std::move(*bvh)) : std::nullopt;
    }

    samples::FloatImage render(restir::Session& session, const restir::Scene& scene_,
                               restir::LightTable& lights, uint32_t index, VkExtent2D extent,
                               restir::Bvh* bvh = nullptr) {
        restir::FrameInput input = host->input(index);
        input.bvh = bvh;
        input.extent = extent;
        input.scene = &scene_;
        input.lights = &lights;
        EXPECT_EQ(lights.upload(input.frameSlot, scene->lights()), Status::Ok);
        device().submitAndWait([&](VkCommandBuffer cmd) {
            EXPECT_EQ(lights.record(cmd, input.frameSlot), Status::Ok);
            if (bvh) {
                EXPECT_EQ(bvh->record(cmd, input.frameSlot, scene->bvhInstances()), Status::Ok);
            }
            host->record(cmd, session, input, unbiased());
        });
        return host->read(input.frameSlot);
    }

    // From a context to nothing but that context: all objects, frames, a resize, frames, the end.
    samples::FloatImage life(const restir::Context& context) {
        auto set = made([&] {
            return restir::Scene::create(context, {.instances = scene->instances(),
                                                   .materials = scene->materials(),
                                                   .textures = scene->textures()});
        });
        auto lights =
            made([&] { return restir::LightTable::create(context, {.maxLights = scene->maxLights()}); });
        auto session = made([&] { return restir::Session::create(context, {.maxExtent = kSmaller}); });
        const bool software = desc.rays == restir::RayBackend::Software;
        std::optional<restir::Bvh> bvh = software ? madeBvh(context) : std::nullopt;
        restir::Bvh* traced = bvh ? &*bvh : nullptr;
        if (!set || !lights || !session || (software && !bvh)) return {};
        const uint32_t before = faults::calls();
        render(*session, *set, *lights, 0, kSmaller, traced);
        EXPECT_EQ(faults::calls(), before) << "recording calls nothing that can fail";
        messages.clear();
        if (session->timings(0).empty()) {
            ++refusals;
            if (messages.find(kNamed.at("vkGetQueryPoolResults")) == std::string::npos) ++wrong;
        }
        auto larger = made(
            [&] { return restir::Session::create(context, {.maxExtent = kExtent, .pairedNeighbours = 4}); });
        if (!larger) return {};
        render(*session, *set, *lights, 1, kSmaller, traced);   // the old one goes on
        *session = std::move(*larger);
        return render(*session, *set, *lights, 2, kExtent, traced);
    }

    struct Row {
        uint32_t failed = 0, refused = 0, leaks = 0, wrong = 0, strangers = 0, changed = 0;
    };
    // Lets `act`, whose calls since faults::reset() those were, meet a failure of each of them; of making pipelines, which is
    // slow and the same for all, of each eighth or twelfth.
    void failEach(const std::vector<std::string>& calls, const std::function<bool()>& act) {
        constexpr VkResult kFaults[] = {VK_ERROR_OUT_OF_HOST_MEMORY, VK_ERROR_OUT_OF_DEVICE_MEMORY,
                                        VK_ERROR_DEVICE_LOST};
        const std::string before = faults::live();
        std::map<std::string, uint32_t> alike;
        for (uint32_t n = 0; n < calls.size(); ++n) {
            const bool slow = calls[n].ends_with("ShaderModule") || calls[n].find("Pipelines") != std::string::npos ||
                              calls[n].find("Handles") != std::string::npos;
            if (slow && alike[calls[n]]++ % (desc.rays == restir::RayBackend::Pipeline ? 12 : 8) != 0) continue;
            faults::reset();
            refusals = leaks = wrong = 0;
            fault = kFaults[n % 3];
            faults::failCallAfter(n, fault);
            const bool same = act();
            Row& row = rows[faults::failed()];
            ++row.failed;
            row.refused += refusals;
            row.leaks += leaks + (faults::live() == before ? 0 : 1);
            row.wrong += wrong;
            row.strangers += faults::strangers();
            row.changed += same ? 0 : 1;
        }
    }

    std::unique_ptr<samples::GpuScene> scene;
    std::unique_ptr<HostView> host;
    restir::ContextDesc desc;
    std::string messages;
    VkResult fault = VK_SUCCESS;
    uint32_t refusals = 0, leaks = 0, wrong = 0;
    std::map<std::string, Row> rows;
};

TEST_F(Failure, OfEveryCallInALife) {
    if (!device().hasRayQuery()) GTEST_SKIP() << kCounted;
    {
        faults::failNames();   // objects without names are as good
        const auto context = restir::Context::create(desc);
        ASSERT_TRUE(context);
        failEach(faults::callNames(), [&] { return !made([&] { return restir::Context::create(desc); }, 1); });
        faults::reset();
        refusals = 0;
        const samples::FloatImage expected = life(*context);
        ASSERT_EQ(refusals, 0u);
        failEach(faults::callNames(), [&] { return life(*context).rgb == expected.rgb; });
    }
    EXPECT_EQ(faults::live(), "");
    const auto line = [](const char* call, const Row& row) {
        std::printf("%-30s %6u %8u %6u %15u %16u %14u\n", call, row.failed, row.refused, row.leaks, row.wrong,
                    row.strangers, row.changed);
    };
    std::printf("%-30s %6s %8s %6s %15s %16s %14s\n", "call", "failed", "refused", "leaks", "wrong statuses",
                "strangers freed", "other pictures");
    Row sum;
    for (const auto& [call, row] : rows) {
        line(call.c_str(), row);
        EXPECT_EQ(row.refused, row.failed) << call;
        EXPECT_EQ(row.leaks + row.wrong + row.strangers + row.changed, 0u) << call;
        sum.failed += row.failed;
    }
    std::printf("%u calls failed\n", sum.failed);
    EXPECT_EQ(rows.size() + kOfRayPipelines, kNamed.size());
}

// A frame that cannot have a pipeline records nothing and leaves nothing; the next try makes what is missing.
TEST_F(Failure, OfEveryCallThatMakesAPipelineOnDemand) {
    if (!device().hasRayQuery()) GTEST_SKIP() << kCounted;
    desc.pipelines = restir::PipelineCreation::OnDemand;
    restir::Settings settings = unbiased();
    settings.di.spatialPasses = 0;
    using Before = std::function<void(restir::Session&, const restir::FrameInput&, VkCommandBuffer)>;
    const auto frames = [&](uint32_t count, const Before& before) {
        const auto context = restir::Context::create(desc);
        const auto set = restir::Scene::create(
            *context, {.instances = scene->instances(), .materials = scene->materials(), .textures = scene->textures()});
        auto lights = restir::LightTable::create(*context, {.maxLights = scene->maxLights()});
        auto session = restir::Session::create(*context, {.maxExtent = kExtent});
        for (uint32_t i = 0; i < count; ++i) {
            restir::FrameInput input = host->input(i);
            input.scene = &*set;
            input.lights = &*lights;
            EXPECT_EQ(lights->upload(input.frameSlot, scene->lights()), Status::Ok);
            device().submitAndWait([&](VkCommandBuffer cmd) {
                EXPECT_EQ(lights->record(cmd, input.frameSlot), Status::Ok);
                if (i == 0) before(*session, input, cmd);
                host->record(cmd, *session, input, settings);
            });
        }
        return host->read((count - 1) % HostView::kSlots).rgb;
    };
    const std::vector<float> one = frames(1, [&](auto&, auto&, auto) { faults::reset(); });
    const uint32_t calls = faults::calls();
    EXPECT_EQ(calls, 2 * 3u);   // a module and a pipeline for each pass
    const std::vector<float> two = frames(2, [&](auto&, auto&, auto) { faults::reset(); });
    EXPECT_EQ(faults::calls(), 2 * 4u);   // with history
    EXPECT_EQ(messages, "");

    constexpr VkResult kFaults[] = {VK_ERROR_OUT_OF_HOST_MEMORY, VK_ERROR_OUT_OF_DEVICE_MEMORY, VK_ERROR_DEVICE_LOST};
    const Before tries[] = {[&](restir::Session& session, const restir::FrameInput& input, VkCommandBuffer cmd) {
                                EXPECT_EQ(session.record(cmd, input, settings), expectedStatus(fault));
                            },
                            [&](restir::Session& session, const restir::FrameInput& input, VkCommandBuffer) {
                                const auto prepared = session.prepare(input, settings);
                                ASSERT_FALSE(prepared);
                                EXPECT_EQ(prepared.error().status, expectedStatus(fault));
                                EXPECT_EQ(prepared.error().vk, fault);
                            },
                            [&](restir::Session& session, const restir::FrameInput& input, VkCommandBuffer) {
                                EXPECT_EQ(session.makePipelines(input, settings), expectedStatus(fault));
                            }};
    for (uint32_t n = 0; n < calls; ++n) {
        const Before& attempt = tries[(n + n / 3) % 3];   // each meets a module and a pipeline
        EXPECT_EQ(frames(1,
                         [&](restir::Session& session, const restir::FrameInput& input, VkCommandBuffer cmd) {
                             fault = kFaults[n % 3];
                             faults::reset();
                             faults::failCallAfter(n, fault);
                             messages.clear();
                             attempt(session, input, cmd);
                             EXPECT_NE(messages.find("pipeline of"), std::string::npos) << messages;
                         }),
                  one)
            << n;
    }
    // Ahead of time: what frames with and without history need, and no frame makes any more.
    EXPECT_EQ(frames(2,
                     [&](restir::Session& session, const restir::FrameInput& input, VkCommandBuffer) {
                         faults::reset();
                         EXPECT_EQ(session.makePipelines(input, settings), Status::Ok);
                         EXPECT_EQ(faults::calls(), 2 * 4u);
                     }),
              two);
    EXPECT_EQ(faults::calls(), 2 * 4u);

    // A light table needs its own.
    const auto context = restir::Context::create(desc);
    fault = VK_ERROR_OUT_OF_DEVICE_MEMORY;
    faults::reset();
    ASSERT_TRUE(restir::LightTable::create(*context, {}));
    const std::vector<std::string> names = faults::callNames();
    const auto first = std::find(names.begin(), names.end(), "vkCreateComputePipelines");
    ASSERT_NE(first, names.end());
    const auto another = restir::Context::create(desc);
    faults::reset();
    faults::failCallAfter(uint32_t(first - names.begin()), fault);
    EXPECT_TRUE(made([&] { return restir::LightTable::create(*another, {}); }));
    EXPECT_EQ(refusals, 1u);
    EXPECT_EQ(leaks + wrong, 0u);
}

// What only a context with ray tracing pipelines calls.
TEST_F(Failure, OfEveryCallThatMakesRayPipelines) {
    if (!device().hasRayPipelines()) GTEST_SKIP() << "no ray tracing pipelines";
    desc.rays = restir::RayBackend::Pipeline;
    ASSERT_TRUE(restir::Context::create(desc));
    failEach(faults::callNames(), [&] { return !made([&] { return restir::Context::create(desc); }, 1); });
    EXPECT_EQ(faults::live(), "");
    for (const auto& [call, row] : rows) {
        EXPECT_EQ(row.refused, row.failed) << call;
        EXPECT_EQ(row.leaks + row.wrong + row.strangers + row.changed, 0u) << call;
    }
    EXPECT_GE(rows["vkCreateRayTracingPipelinesKHR"].failed, 2u);
    EXPECT_GE(rows["vkGetRayTracingShaderGroupHandlesKHR"].failed, 3u);
    EXPECT_EQ(rows["vkAllocateMemory"].failed, 1u);
}

// The same with the objects that only the software ray backend has.
TEST_F(Failure, OfEveryCallInALifeWithABvh) {
    desc.rays = restir::RayBackend::Software;
    {
        const auto context = restir::Context::create(desc);
        ASSERT_TRUE(context);
        faults::reset();
        const samples::FloatImage expected = life(*context);
        failEach(faults::callNames(), [&] { return life(*context).rgb == expected.rgb; });
    }
    EXPECT_EQ(faults::live(), "");
    uint32_t failed = 0;
    for (const auto& [call, row] : rows) {
        EXPECT_EQ(row.refused, row.failed) << call;
        EXPECT_EQ(row.leaks + row.wrong + row.strangers + row.changed, 0u) << call;
        failed += row.failed;
    }
    std::printf("%u calls failed\n", failed);
    EXPECT_GT(failed, 40u);
}

// No timings, no complaint, the same picture.
TEST_F(Failure, DeviceWithoutTimestamps) {
    desc.pipelines = restir::PipelineCreation::OnDemand;
    std::vector<float> pictures[2];
    for (auto& picture : pictures) {
        const auto context = restir::Context::create(desc);
        ASSERT_TRUE(context);
        const auto set = restir::Scene::create(*context, {.instances = scene->instances(),
                                                          .materials = scene->materials(),
                                                          .textures = scene->textures()});
        auto lights = restir::LightTable::create(*context, {.maxLights = scene->maxLights()});
        auto session = restir::Session::create(*context, {.maxExtent = kExtent});
        ASSERT_TRUE(set && lights && session);
        picture = render(*session, *set, *lights, 0, kExtent).rgb;
        EXPECT_EQ(session->timings(0).empty(), &picture == &pictures[1]);
        faults::hideTimestamps();
    }
    EXPECT_EQ(pictures[0], pictures[1]);
    EXPECT_EQ(messages, "");
    EXPECT_EQ(faults::live(), "");
}

// A loader or device without one of the functions: the message names it.
TEST_F(Failure, OfEveryLookup) {
    desc.pipelines = restir::PipelineCreation::OnDemand;
    ASSERT_TRUE(restir::Context::create(desc));
    const uint32_t lookups = faults::lookups();
    uint32_t refused = 0;
    for (uint32_t n = 0; n < lookups; ++n) {
        faults::reset();
        faults::failLookupAfter(n);
        messages.clear();
        const auto context = restir::Context::create(desc);
        if (faults::failed().ends_with("EXT")) {   // names and labels
            EXPECT_TRUE(context) << faults::failed();
            continue;
        }
        ++refused;
        ASSERT_FALSE(context) << faults::failed();
        EXPECT_EQ(context.error().status, Status::MissingFeature);
        EXPECT_NE(messages.find(faults::failed()), std::string::npos) << messages;
        EXPECT_EQ(faults::live(), "");
    }
    EXPECT_GT(refused, 30u);
    EXPECT_EQ(faults::live(), "");
}

}   // namespace
}   // namespace tests
