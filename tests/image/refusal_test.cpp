// Bad input is refused by name, and leaves no trace.
#include <gtest/gtest.h>

#include <cstdio>
#include <functional>
#include <limits>

#include <common/setting_options.h>

#include "image/host_view.h"
#include "image/hypothesis.h"
#include "image/stage.h"
#include "image/world.h"

namespace tests {
namespace {

using restir::FrameInput;
using restir::Settings;
using restir::Status;

constexpr VkExtent2D kExtent{16, 16};
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

class Refusal : public testing::Test {
protected:
    Refusal() {
        samples::SceneData data = planeScene();
        addQuad(data, lamp({0, 1, 0}, 0.5f), {.emission = {1, 1, 1}});
        const samples::View view = data.views[0];
        scene = std::make_unique<samples::GpuScene>(device(), std::move(data));
        host = std::make_unique<HostView>(*scene, view, HostDesc{.maxExtent = kExtent});
    }
    // The status is InvalidArgument and the message has `field` in it.
    static void expectRefusal(Status status, const char* field) {
        EXPECT_EQ(status, Status::InvalidArgument);
        EXPECT_NE(device().sdkError().find(field), std::string::npos) << field << ": " << device().sdkError();
    }
    Status record(const FrameInput& input, const Settings& settings) {
        Status status = Status::Ok;
        device().submitAndWait(
            [&](VkCommandBuffer cmd) { status = host->session().record(cmd, input, settings); });
        return status;
    }

    std::unique_ptr<samples::GpuScene> scene;
    std::unique_ptr<HostView> host;
};

// What the samples let a user choose is what the library takes.
TEST_F(Refusal, IsWhereTheSamplesRangesEnd) {
    for (const samples::SettingOption& option : samples::settingOptions()) {
        if (option.least == option.most) continue;
        const auto takes = [&](double value) {
            char text[32];
            std::snprintf(text, sizeof text, "%.9g", value);
            Settings settings;
            EXPECT_TRUE(option.set(settings, text)) << option.name << " " << text;
            return static_cast<bool>(host->session().plan(host->input(0), settings));
        };
        EXPECT_TRUE(takes(option.least)) << option.name << ": " << device().sdkError();
        EXPECT_TRUE(takes(option.most)) << option.name << ": " << device().sdkError();
        if (!option.whole) continue;
        EXPECT_FALSE(takes(option.most + 1)) << option.name;
        if (option.least > 0) {   // below 0 there is nothing to set
            EXPECT_FALSE(takes(option.least - 1)) << option.name;
        }
    }
}

struct BadFrame {
    const char* field;
    std::function<void(FrameInput&, Settings&)> spoil;
};

const BadFrame kBadFrames[] = {
    {"frameSlot", [](FrameInput& f, Settings&) { f.frameSlot = HostView::kSlots; }},
    {"extent", [](FrameInput& f, Settings&) { f.extent.width = 0; }},
    {"extent", [](FrameInput& f, Settings&) { f.extent.height = 0; }},
    {"extent", [](FrameInput& f, Settings&) { f.extent.width = kExtent.width + 1; }},
    {"extent", [](FrameInput& f, Settings&) { f.extent.height = ~0u; }},
    {"lights", [](FrameInput& f, Settings&) { f.lights = nullptr; }},
    {"tlas", [](FrameInput& f, Settings&) { f.tlas = VK_NULL_HANDLE; }},
    {"scene", [](FrameInput& f, Settings&) { f.scene = nullptr; }},
    {"depth", [](FrameInput& f, Settings&) { f.gbuffer.depth = {}; }},
    {"normal", [](FrameInput& f, Settings&) { f.gbuffer.normal = {}; }},
    {"baseColor", [](FrameInput& f, Settings&) { f.gbuffer.baseColor = {}; }},
    {"normals", [](FrameInput& f, Settings&) { f.gbuffer.normals = restir::NormalEncoding(4); }},
    {"depthKind", [](FrameInput& f, Settings&) { f.gbuffer.depthKind = restir::DepthKind(2); }},
    {"motionScale", [](FrameInput& f, Settings&) { f.gbuffer.motionScale[1] = kNan; }},
    {"gbuffer.origin", [](FrameInput& f, Settings&) { f.gbuffer.origin.x = -1; }},
    {"output.origin", [](FrameInput& f, Settings&) { f.output.origin.y = -1; }},
    {"radiance", [](FrameInput& f, Settings&) { f.output.radiance = VK_NULL_HANDLE; }},
    {"exposure", [](FrameInput& f, Settings&) { f.exposure = kNan; }},
    {"exposure", [](FrameInput& f, Settings&) { f.exposure = -1; }},
    {"viewFromWorld", [](FrameInput& f, Settings&) { f.camera.viewFromWorld.m[12] = kNan; }},
    {"viewFromWorld", [](FrameInput& f, Settings&) { f.camera.viewFromWorld = {.m = {0}}; }},
    {"viewFromWorld", [](FrameInput& f, Settings&) { f.camera.viewFromWorld.m[3] = 1; }},
    {"clipFromView", [](FrameInput& f, Settings&) { f.camera.clipFromView.m[0] = kNan; }},
    {"clipFromView", [](FrameInput& f, Settings&) { f.camera.clipFromView.m[5] = 0; }},
    {"clipFromView", [](FrameInput& f, Settings&) { f.camera.clipFromView.m[11] = -2; }},
    {"jitter", [](FrameInput& f, Settings&) { f.camera.jitter[0] = std::numeric_limits<float>::infinity(); }},
    {"debugView", [](FrameInput&, Settings& s) { s.debugView = restir::DebugView(9); }},
    {"debug", [](FrameInput&, Settings& s) { s.debugView = restir::DebugView::Age; }},
    {"DirectMode",
     [](FrameInput& f, Settings& s) {
         f.output.debug = f.output.radiance;
         s.debugView = restir::DebugView::Age;
         s.di.mode = restir::DirectMode::NextEvent;
     }},
    {"gradient",
     [](FrameInput& f, Settings& s) {
         f.output.gradient = f.output.radiance;
         s.di.mode = restir::DirectMode::NextEvent;
     }},
    {"spatialPasses",
     [](FrameInput& f, Settings& s) {
         f.output.debug = f.output.radiance;
         s.debugView = restir::DebugView::Neighbours;
         s.di.spatialPasses = 0;
     }},
    {"mode", [](FrameInput&, Settings& s) { s.di.mode = restir::DirectMode(3); }},
    {"GiSettings::mode", [](FrameInput&, Settings& s) { s.gi.mode = restir::IndirectMode(3); }},
    {"SessionDesc::indirect", [](FrameInput&, Settings& s) { s.gi.mode = restir::IndirectMode::Restir; }},
    {"indirectSpecular", [](FrameInput& f, Settings&) { f.output.indirectSpecular = f.output.radiance; }},
    {"GiSettings::bounces", [](FrameInput&, Settings& s) { s.gi.bounces = 1; }},
    {"GiSettings::boilingFilter", [](FrameInput&, Settings& s) { s.gi.boilingFilter = -0.1f; }},
    {"GiSettings::visibility",
     [](FrameInput&, Settings& s) { s.gi.visibility = restir::VisibilityReuse::None; }},
    {"lightCandidates", [](FrameInput&, Settings& s) { s.di.lightCandidates = 0; }},
    {"lightCandidates", [](FrameInput&, Settings& s) { s.di.lightCandidates = 65537; }},
    {"initialSamples", [](FrameInput&, Settings& s) { s.di.initialSamples = 0; }},
    {"initialSamples", [](FrameInput&, Settings& s) { s.di.initialSamples = 9; }},
    {"cutSamples", [](FrameInput&, Settings& s) { s.di.cutSamples = 0; }},
    {"cutSamples", [](FrameInput&, Settings& s) { s.di.cutSamples = 9; }},
    {"bsdfCandidates", [](FrameInput&, Settings& s) { s.di.bsdfCandidates = 9; }},
    {"maxHistory", [](FrameInput&, Settings& s) { s.di.maxHistory = 1001; }},
    {"spatialPasses", [](FrameInput&, Settings& s) { s.di.spatialPasses = 9; }},
    {"neighbours", [](FrameInput&, Settings& s) { s.di.neighbours = 0; }},
    {"neighbours", [](FrameInput&, Settings& s) { s.di.neighbours = 17; }},
    {"pairedNeighbours",
     [](FrameInput&, Settings& s) { s.di.pairedNeighbours = true; }},   // but not declared
    {"radius", [](FrameInput&, Settings& s) { s.di.radius = 0; }},
    {"radius", [](FrameInput&, Settings& s) { s.di.radius = kNan; }},
    {"normalThreshold", [](FrameInput&, Settings& s) { s.di.normalThreshold = 1.1f; }},
    {"depthThreshold", [](FrameInput&, Settings& s) { s.di.depthThreshold = kNan; }},
    {"boilingFilter", [](FrameInput&, Settings& s) { s.di.boilingFilter = kNan; }},
    {"boilingFilter", [](FrameInput&, Settings& s) { s.di.boilingFilter = 1.1f; }},
    {"weights", [](FrameInput&, Settings& s) { s.di.weights = restir::Weights(5); }},
    {"visibility", [](FrameInput&, Settings& s) { s.di.visibility = restir::VisibilityReuse(3); }},
};

TEST_F(Refusal, FramesAndSettings) {
    host->frames(0, 2, unbiased());
    const samples::FloatImage expected = host->frames(2, 1, unbiased());
    host->newSession();
    host->frames(0, 2, unbiased());
    for (const BadFrame& bad : kBadFrames) {
        SCOPED_TRACE(bad.field);
        FrameInput input = host->input(2);
        Settings settings = unbiased();
        bad.spoil(input, settings);
        expectRefusal(record(input, settings), bad.field);
        const auto planned = host->session().plan(input, settings);
        ASSERT_FALSE(planned);
        expectRefusal(planned.error().status, bad.field);
    }
    EXPECT_EQ(host->frames(2, 1, unbiased()).rgb, expected.rgb);   // as if none of them had been
}

TEST_F(Refusal, NullCommandBuffers) {
    expectRefusal(host->session().record(VK_NULL_HANDLE, host->input(0), unbiased()), "cmd");
    expectRefusal(host->lights().record(VK_NULL_HANDLE, 0), "cmd");
}

TEST_F(Refusal, UploadsThatAreNotRecorded) {
    ASSERT_EQ(host->lights().upload(1, scene->lights()), Status::Ok);
    expectRefusal(record(host->input(0), unbiased()), "lights");
    device().submitAndWait([&](VkCommandBuffer cmd) {
        expectRefusal(host->lights().record(cmd, 2), "frameSlot");   // the upload went to 1
        EXPECT_EQ(host->lights().record(cmd, 1), Status::Ok);
    });
    EXPECT_EQ(record(host->input(0), unbiased()), Status::Ok);
}

TEST_F(Refusal, Lights) {
    expectRefusal(host->lights().upload(HostView::kSlots, {}), "frameSlot");
    restir::Light light{.id = scene->maxLights()};
    expectRefusal(host->lights().upload(0, std::span(&light, 1)), "id");
    light.id = 0;
    light.emission[1] = kNan;
    expectRefusal(host->lights().upload(0, std::span(&light, 1)), "emission");
    light.emission[1] = 3e38f;
    expectRefusal(host->lights().upload(0, std::span(&light, 1)), "light 0 (id 0): bad emission (above 1e30)");
    // The lights of before are still there, and nothing waits to be recorded.
    EXPECT_GT(largest(host->frames(0, 1, unbiased())), 0);
}

// Neither lights that were recorded nor, in the same slot, lights that wait to be.
TEST_F(Refusal, BadLightsLeaveGoodOnesAlone) {
    const auto pointAt = [](float x) {
        return restir::Light{.id = 0, .kind = restir::LightKind::Point, .position = {x, 1, 0}};
    };
    const restir::Light good = pointAt(0);
    restir::Light bad = pointAt(0);
    bad.id = 1;
    bad.emission[1] = kNan;
    host->upload(std::vector{good});
    const samples::FloatImage expected = host->frames(0, 1, unbiased());
    host->newSession();
    expectRefusal(host->lights().upload(0, std::vector{pointAt(0.5f), bad}), "light 1 (id 1)");
    EXPECT_EQ(host->frames(0, 1, unbiased()).rgb, expected.rgb);
    host->upload(std::vector{pointAt(0.7f)});
    EXPECT_EQ(host->lights().upload(0, std::vector{good}), Status::Ok);
    expectRefusal(host->lights().upload(0, std::vector{pointAt(0.5f), bad}), "light 1 (id 1)");
    device().submitAndWait(
        [&](VkCommandBuffer cmd) { EXPECT_EQ(host->lights().record(cmd, 0), Status::Ok); });
    host->newSession();
    EXPECT_EQ(host->frames(0, 1, unbiased()).rgb, expected.rgb);
}

TEST_F(Refusal, EnvironmentMaps) {
    auto table = restir::LightTable::create(host->context(), {.maxLights = 1, .maxEnvironmentTexels = 2});
    ASSERT_TRUE(table);
    for (const float bad : {3e38f, -1.0f, kNan}) {
        const float rgb[] = {0, 0, 0, 1, bad, 1};
        expectRefusal(table->uploadEnvironment({2, 1, rgb}), "at texel (1, 0), must be in [0, 1e30]");
    }
    const float rgb[9] = {};
    expectRefusal(table->uploadEnvironment({3, 1, rgb}), "maxEnvironmentTexels");
}

TEST_F(Refusal, Sessions) {
    for (VkExtent2D extent : {VkExtent2D{0, 1}, VkExtent2D{1, 0}, VkExtent2D{1u << 20, 1u << 20}}) {
        const auto session = restir::Session::create(host->context(), {.maxExtent = extent});
        ASSERT_FALSE(session);
        expectRefusal(session.error().status, "maxExtent");
    }
    const auto many =
        restir::Session::create(host->context(), {.maxExtent = kExtent, .pairedNeighbours = 17});
    ASSERT_FALSE(many);
    expectRefusal(many.error().status, "pairedNeighbours");
    const auto table = restir::LightTable::create(host->context(), {.maxLights = (1u << 20) + 1});
    ASSERT_FALSE(table);
    expectRefusal(table.error().status, "maxLights");
    const auto meshes = restir::LightTable::create(host->context(), {.maxLights = 4, .meshLights = 5});
    ASSERT_FALSE(meshes);
    expectRefusal(meshes.error().status, "meshLights");
}

TEST_F(Refusal, Contexts) {
    const std::pair<const char*, std::function<void(restir::ContextDesc&)>> cases[] = {
        {"getInstanceProcAddr", [](restir::ContextDesc& d) { d.device.getInstanceProcAddr = nullptr; }},
        {"instance", [](restir::ContextDesc& d) { d.device.instance = VK_NULL_HANDLE; }},
        {"physicalDevice", [](restir::ContextDesc& d) { d.device.physicalDevice = VK_NULL_HANDLE; }},
        {"device", [](restir::ContextDesc& d) { d.device.device = VK_NULL_HANDLE; }},
        {"framesInFlight", [](restir::ContextDesc& d) { d.framesInFlight = 0; }},
        {"framesInFlight", [](restir::ContextDesc& d) { d.framesInFlight = 17; }},
        {"maxTextures", [](restir::ContextDesc& d) { d.maxTextures = 0; }},
        {"pipelines", [](restir::ContextDesc& d) { d.pipelines = restir::PipelineCreation(2); }},
        {"queueFamily", [](restir::ContextDesc& d) { d.queueFamily = 99; }},
        {"memory",
         [](restir::ContextDesc& d) { d.device.memory.release = [](void*, const restir::BufferGrant&) {}; }},
    };
    for (const auto& [field, spoil] : cases) {
        SCOPED_TRACE(field);
        restir::ContextDesc desc = HostView::contextDesc();
        spoil(desc);
        const auto context = restir::Context::create(desc);
        ASSERT_FALSE(context);
        expectRefusal(context.error().status, field);
    }
}

TEST_F(Refusal, ShadersOfAnotherVersion) {
    restir::ContextDesc desc = HostView::contextDesc();
    restir::ShaderPack pack{.shaderAbi = RESTIR_SHADER_ABI + 1, .modules = {}, .rays = desc.rays};
    desc.shaders = &pack;
    EXPECT_EQ(restir::Context::create(desc).error().status, Status::ShaderMismatch);
    pack.shaderAbi = RESTIR_SHADER_ABI;   // but without a single pass
    EXPECT_EQ(restir::Context::create(desc).error().status, Status::ShaderMismatch);
    EXPECT_NE(device().sdkError().find("ContextDesc::shaders lacks the pass "), std::string::npos)
        << device().sdkError();   // surface.pack, or rays.miss where there are only pipelines
}

}   // namespace
}   // namespace tests
