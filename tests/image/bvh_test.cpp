// What a Bvh refuses, takes and keeps: fields by name, memory to the byte, and the history of the views that
// trace it.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <string_view>

#include "image/host_view.h"
#include "image/stage.h"
#include "image/world.h"

namespace tests {
namespace {

using restir::Status;

constexpr VkExtent2D kExtent{16, 16};

class BvhObject : public testing::Test {
protected:
    BvhObject() {
        samples::SceneData data = planeScene();
        addQuad(data, lamp({0, 1, 0}, 0.5f), {.emission = {1, 1, 1}});
        const samples::View view = data.views[0];
        scene = std::make_unique<samples::GpuScene>(device(), std::move(data));
        host = std::make_unique<HostView>(
            *scene, view, HostDesc{.maxExtent = kExtent, .rays = restir::RayBackend::Software});
        meshes = scene->makeBvhMeshes();
    }
    restir::Bvh another() {
        return device().require(restir::Bvh::create(host->context(), {.meshes = meshes, .maxInstances = 2}),
                                "Bvh");
    }
    static void expectRefusal(Status status, const char* words) {
        EXPECT_EQ(status, Status::InvalidArgument);
        EXPECT_NE(device().sdkError().find(words), std::string::npos) << words << ": " << device().sdkError();
    }
    Status record(restir::Bvh& bvh, std::span<const restir::BvhInstance> instances, uint32_t slot = 0) {
        Status status = Status::Ok;
        device().submitAndWait([&](VkCommandBuffer cmd) { status = bvh.record(cmd, slot, instances); });
        return status;
    }
    // Whether the frame reuses the last one's reservoirs.
    bool remembers(uint32_t index, const restir::Bvh* bvh = nullptr) {
        restir::FrameInput input = host->input(index);
        if (bvh) input.bvh = bvh;
        const auto plan = host->session().plan(input, unbiased());
        const bool result = plan && std::any_of(plan->begin(), plan->end(), [](const restir::PassInfo& pass) {
                                return std::string_view(pass.name) == "di.temporal";
                            });
        host->frame(input, unbiased());
        return result;
    }

    std::unique_ptr<samples::GpuScene> scene;
    std::unique_ptr<HostView> host;
    std::vector<restir::BvhMesh> meshes;
};

TEST_F(BvhObject, RefusesByName) {
    const std::vector<restir::BvhInstance> good = scene->bvhInstances();
    restir::Bvh bvh = another();
    restir::FrameInput frame = host->input(0);
    const auto expectFrame = [&](const char* words) {
        const auto plan = host->session().plan(frame, unbiased());
        ASSERT_FALSE(plan);
        expectRefusal(plan.error().status, words);
    };
    frame.bvh = nullptr;
    expectFrame("FrameInput::bvh is null");
    frame.bvh = &bvh;
    expectFrame("FrameInput::bvh has no Bvh::record yet");
    frame.tlas = VK_NULL_HANDLE;   // nobody asks for it
    EXPECT_EQ(record(bvh, good), Status::Ok);
    EXPECT_TRUE(host->session().plan(frame, unbiased()));

    expectRefusal(bvh.record(VK_NULL_HANDLE, 0, good), "Bvh::record: cmd is null");
    expectRefusal(record(bvh, good, HostView::kSlots), "frameSlot is 4");
    std::vector<restir::BvhInstance> bad = good;
    bad.insert(bad.end(), good.begin(), good.end());
    expectRefusal(record(bvh, bad), "there are 4 instances, BvhDesc::maxInstances is 2");
    bad = good;
    bad[1].mesh = 2;
    expectRefusal(record(bvh, bad), "BvhInstance::mesh of instance 1 is 2");
    bad = good;
    bad[0].worldFromObject[2][3] = std::numeric_limits<float>::quiet_NaN();
    expectRefusal(record(bvh, bad), "BvhInstance::worldFromObject of instance 0 is not finite");
}

TEST_F(BvhObject, IsOfItsContextAndBackend) {
    const auto expectNone = [&](const restir::Context& context, const restir::BvhDesc& desc,
                                const char* words) {
        const auto bvh = restir::Bvh::create(context, desc);
        ASSERT_FALSE(bvh);
        expectRefusal(bvh.error().status, words);
    };
    const uint64_t most = device().properties().limits.maxStorageBufferRange / 128;
    expectNone(host->context(), {.maxInstances = uint32_t(most) + 1},
               ("maxInstances is " + std::to_string(most + 1) + ", this device takes " + std::to_string(most))
                   .c_str());
    const HostView other(*scene, {}, HostDesc{.maxExtent = kExtent}),
        third(*scene, {}, HostDesc{.maxExtent = kExtent, .rays = restir::RayBackend::Software});
    expectNone(other.context(), {}, "ContextDesc::rays");
    restir::FrameInput frame = host->input(0);
    restir::Bvh foreign = device().require(restir::Bvh::create(third.context(), {}), "Bvh");
    frame.bvh = &foreign;
    EXPECT_FALSE(host->session().plan(frame, unbiased()));
    EXPECT_NE(device().sdkError().find("FrameInput::bvh is of another Context"), std::string::npos);

    restir::ContextDesc desc = HostView::contextDesc();
    desc.rays = restir::RayBackend::Own;
    EXPECT_FALSE(restir::Context::create(desc));
    EXPECT_NE(device().sdkError().find("ContextDesc::shaders is null"), std::string::npos);
    const restir::ShaderPack nothing{
        .shaderAbi = RESTIR_SHADER_ABI, .modules = {}, .rays = restir::RayBackend::Software};
    desc.shaders = &nothing;
    const auto context = restir::Context::create(desc);
    ASSERT_FALSE(context);
    EXPECT_EQ(context.error().status, Status::ShaderMismatch);
    EXPECT_NE(device().sdkError().find("ContextDesc::shaders trace with RayBackend 2"), std::string::npos);
}

// A record() a frame, or none: last frame's instances are there. More, and they are not.
TEST_F(BvhObject, ViewsKeepTheirHistoryOverOneRecord) {
    const std::vector<restir::BvhInstance> instances = scene->bvhInstances();
    EXPECT_FALSE(remembers(0));
    EXPECT_TRUE(remembers(1));
    EXPECT_EQ(record(*host->bvh(), instances, 2), Status::Ok);
    EXPECT_TRUE(remembers(2));
    for (uint32_t slot : {0u, 3u}) EXPECT_EQ(record(*host->bvh(), instances, slot), Status::Ok);
    EXPECT_FALSE(remembers(3));
    EXPECT_TRUE(remembers(4));
    restir::Bvh next = another();   // streamed in
    EXPECT_EQ(record(next, instances), Status::Ok);
    EXPECT_TRUE(remembers(5, &next));
    EXPECT_TRUE(remembers(6, &next));
}

// Counts what it hands out.
struct Provider {
    VkDeviceSize bytes = 0;
    std::map<VkBuffer, samples::Buffer> live;

    static VkResult acquire(void* user, const restir::BufferRequest& request, restir::BufferGrant& grant) {
        auto& self = *static_cast<Provider*>(user);
        const auto kind = request.use == restir::MemoryUse::DeviceOnly ? samples::MemoryKind::Gpu
                                                                       : samples::MemoryKind::Upload;
        samples::Buffer buffer(device(), {.size = request.size, .usage = request.usage, .memory = kind});
        grant = {.buffer = buffer.handle(), .mapped = buffer.mapped()};
        self.bytes += request.size;
        self.live.emplace(grant.buffer, std::move(buffer));
        return VK_SUCCESS;
    }
    static void release(void* user, const restir::BufferGrant& grant) {
        auto& self = *static_cast<Provider*>(user);
        self.bytes -= self.live.at(grant.buffer).size();
        self.live.erase(grant.buffer);
    }
};

TEST_F(BvhObject, TakesWhatItSaid) {
    Provider provider;
    restir::ContextDesc desc = HostView::contextDesc();
    desc.device.memory = {.user = &provider, .acquire = Provider::acquire, .release = Provider::release};
    desc.rays = restir::RayBackend::Software;
    const restir::Context context = device().require(restir::Context::create(desc), "Context");
    for (uint32_t instances : {0u, 1u, 1000u}) {
        for (std::span<const restir::BvhMesh> chosen :
             {std::span<const restir::BvhMesh>(), std::span<const restir::BvhMesh>(meshes)}) {
            const restir::BvhDesc bvhDesc{.meshes = chosen, .maxInstances = instances};
            restir::Bvh bvh = device().require(restir::Bvh::create(context, bvhDesc), "Bvh");
            EXPECT_EQ(provider.bytes, restir::Bvh::memoryNeeded(context, bvhDesc));
            bvh.releaseStaging();   // nothing: the meshes have not been recorded
            EXPECT_EQ(provider.bytes, restir::Bvh::memoryNeeded(context, bvhDesc));
            EXPECT_EQ(record(bvh, {}), Status::Ok);
            bvh.releaseStaging();
            EXPECT_LT(provider.bytes, restir::Bvh::memoryNeeded(context, bvhDesc));
        }
    }
    EXPECT_EQ(provider.bytes, 0u);
}

}   // namespace
}   // namespace tests
