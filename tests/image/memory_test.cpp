// What the SDK allocates, with its own blocks and with a host's provider.
#include <gtest/gtest.h>

#include <memory>
#include <set>

#include "image/host_view.h"
#include "image/hypothesis.h"
#include "image/stage.h"
#include "image/world.h"

namespace tests {
namespace {

constexpr VkExtent2D kExtent{48, 20};

// One allocation a buffer, as a host's allocator might do; refuses what comes after `allowed` buffers.
class Provider {
public:
    restir::MemoryProvider sdk() { return {.user = this, .acquire = acquire, .release = release}; }

    uint32_t allowed = ~0u;
    uint32_t acquired = 0;
    VkDeviceSize bytes = 0;   // of live buffers
    std::set<void*> live;

private:
    static VkResult acquire(void* user, const restir::BufferRequest& request, restir::BufferGrant& grant) {
        auto& self = *static_cast<Provider*>(user);
        EXPECT_GT(request.size, 0u);
        EXPECT_STRNE(request.name, "");
        if (self.acquired == self.allowed) return VK_ERROR_OUT_OF_DEVICE_MEMORY;
        ++self.acquired;
        const samples::MemoryKind kind = request.use == restir::MemoryUse::DeviceOnly  ? samples::MemoryKind::Gpu
                                         : request.use == restir::MemoryUse::HostWrite ? samples::MemoryKind::Upload
                                                                                       : samples::MemoryKind::Readback;
        auto buffer = std::make_unique<samples::Buffer>(
            device(), samples::BufferDesc{.size = request.size, .usage = request.usage, .memory = kind});
        grant = {.buffer = buffer->handle(), .mapped = buffer->mapped(), .token = buffer.get()};
        self.bytes += request.size;
        self.live.insert(buffer.release());
        return VK_SUCCESS;
    }
    static void release(void* user, const restir::BufferGrant& grant) {
        auto& self = *static_cast<Provider*>(user);
        ASSERT_EQ(self.live.erase(grant.token), 1u);
        auto* buffer = static_cast<samples::Buffer*>(grant.token);
        EXPECT_EQ(grant.buffer, buffer->handle());
        delete buffer;
    }
};

class Memory : public testing::Test {
protected:
    Memory() {
        samples::SceneData data = planeScene();
        addQuad(data, lamp({0, 1, 0}, 0.5f), {.emission = {1, 1, 1}});
        view = data.views[0];
        scene = std::make_unique<samples::GpuScene>(device(), std::move(data));
    }
    std::unique_ptr<HostView> host(const restir::MemoryProvider& memory = {},
                                   restir::RayBackend rays = device().bestRays()) const {
        return std::make_unique<HostView>(*scene, view, HostDesc{.maxExtent = kExtent, .memory = memory, .rays = rays});
    }

    samples::View view;
    std::unique_ptr<samples::GpuScene> scene;
};

TEST_F(Memory, ProviderSeesWhatWasAnnounced) {
    Provider provider;
    {
        restir::ContextDesc desc = HostView::contextDesc();
        desc.device.memory = provider.sdk();
        desc.rays = restir::RayBackend::Software;   // whose Context needs nothing
        auto context = restir::Context::create(desc);
        ASSERT_TRUE(context);
        EXPECT_EQ(provider.acquired, 0u);
        const auto session = restir::Session::create(*context, {.maxExtent = kExtent});
        ASSERT_TRUE(session);
        EXPECT_EQ(provider.bytes, restir::Session::memoryNeeded(*context, {.maxExtent = kExtent}));
        for (const restir::LightTableDesc& lights :
             {restir::LightTableDesc{.maxLights = 1000}, {.maxLights = 1000, .meshLights = 700, .maxMeshes = 9}, {}}) {
            const VkDeviceSize before = provider.bytes;
            const auto table = restir::LightTable::create(*context, lights);
            ASSERT_TRUE(table);
            EXPECT_EQ(provider.bytes - before, restir::LightTable::memoryNeeded(*context, lights));
        }
    }
    EXPECT_TRUE(provider.live.empty());
}

// With pipelines the Context's binding table is the provider's, too; the software backend's trees are.
TEST_F(Memory, ProviderGivesTheSamePicture) {
    for (const restir::RayBackend rays :
         {restir::RayBackend::RayQuery, restir::RayBackend::Pipeline, restir::RayBackend::Software}) {
        if (!device().has(rays)) continue;
        Provider provider;
        restir::Settings settings = unbiased();
        if (rays != device().bestRays()) settings.di.spatialPasses = 0;   // the same buffers in fewer shaders
        const samples::FloatImage expected = host({}, rays)->frames(0, 3, settings);
        {
            const std::unique_ptr<HostView> provided = host(provider.sdk(), rays);
            EXPECT_EQ(provided->frames(0, 3, settings).rgb, expected.rgb) << "backend " << int(rays);
            EXPECT_FALSE(provider.live.empty());
        }
        EXPECT_TRUE(provider.live.empty());
    }
}

TEST_F(Memory, WithoutRoomForTheBindingTableThereIsNoContext) {
    Provider provider;
    provider.allowed = 0;
    restir::ContextDesc desc = HostView::contextDesc();
    desc.device.memory = provider.sdk();
    desc.rays = restir::RayBackend::Pipeline;
    const auto context = restir::Context::create(desc);
    ASSERT_FALSE(context);
    EXPECT_EQ(context.error().status, restir::Status::OutOfDeviceMemory);
    EXPECT_TRUE(provider.live.empty());
}

TEST_F(Memory, FailureAtAnyBufferLeavesNothing) {
    Provider provider;
    restir::ContextDesc desc = HostView::contextDesc();
    desc.device.memory = provider.sdk();
    desc.rays = restir::RayBackend::Software;
    auto context = restir::Context::create(desc);
    ASSERT_TRUE(context);
    uint32_t failures = 0;
    for (provider.allowed = 0;; ++provider.allowed, ++failures) {
        provider.acquired = 0;
        const auto session = restir::Session::create(*context, {.maxExtent = kExtent});
        if (session) break;
        EXPECT_EQ(session.error().status, restir::Status::OutOfDeviceMemory);
        EXPECT_EQ(session.error().vk, VK_ERROR_OUT_OF_DEVICE_MEMORY);
        EXPECT_TRUE(provider.live.empty()) << provider.allowed;
        ASSERT_LT(failures, 100u);
    }
    EXPECT_GT(failures, 8u);
    EXPECT_TRUE(provider.live.empty());
    provider.acquired = provider.allowed = 0;
    EXPECT_EQ(restir::LightTable::create(*context, {.maxLights = 8}).error().status,
              restir::Status::OutOfDeviceMemory);
    EXPECT_TRUE(provider.live.empty());
}

// 32 for reservoirs, 56 for surfaces: two frames of 24 bytes and 8 of this frame.
TEST_F(Memory, EightyEightBytesAPixel) {
    const std::unique_ptr<HostView> view88 = host();
    VkDeviceSize perPixel = 0, all = 0;
    for (const restir::BufferInfo& buffer : view88->session().memory()) {
        if (buffer.perPixel) perPixel += buffer.bytes;
        all += buffer.bytes;
    }
    EXPECT_EQ(perPixel, VkDeviceSize{88} * kExtent.width * kExtent.height);
    // What its blocks take is what it asks for, but for the gaps between buffers.
    const VkDeviceSize needed = restir::Session::memoryNeeded(view88->context(), {.maxExtent = kExtent});
    EXPECT_GE(needed, all);
    EXPECT_LE(needed, all + VkDeviceSize{256} * view88->session().memory().size());
}

// Two bytes for each partner and one more, in whole words.
TEST_F(Memory, PartnersTakeWhatIsDeclared) {
    const std::unique_ptr<HostView> plain = host();
    const VkDeviceSize without = restir::Session::memoryNeeded(plain->context(), {.maxExtent = kExtent});
    for (auto [neighbours, bytes] :
         {std::pair(1u, 4u), std::pair(4u, 12u), std::pair(5u, 12u), std::pair(16u, 36u)}) {
        const restir::SessionDesc desc{.maxExtent = kExtent, .pairedNeighbours = neighbours};
        const VkDeviceSize needed = restir::Session::memoryNeeded(plain->context(), desc);
        EXPECT_NEAR(double(needed - without), double(bytes) * kExtent.width * kExtent.height, 256);
        const auto session = restir::Session::create(plain->context(), desc);
        ASSERT_TRUE(session);
        VkDeviceSize perPixel = 0;
        for (const restir::BufferInfo& buffer : session->memory())
            perPixel += buffer.perPixel ? buffer.bytes : 0;
        EXPECT_EQ(perPixel, VkDeviceSize{88 + bytes} * kExtent.width * kExtent.height);
    }
}

}   // namespace
}   // namespace tests
