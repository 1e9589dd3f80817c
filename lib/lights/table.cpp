#include <lights/table_impl.h>

#include <algorithm>
#include <cstring>
#include <utility>

#include <device/barrier.h>
#include <device/internals.h>
#include <lights/build.h>
#include <lights/tree.h>
#include <restir/shared/light_table.h>
#include <scene/scene_impl.h>

namespace restir {
namespace {

constexpr uint32_t kMaxLights = 1u << 20;
constexpr uint32_t kMaxTimedPasses = 14;
constexpr VkDeviceSize kLightBytes = sizeof(gpu::RsPackedLight);

// Of the staging buffers: room for uploaded lights, behind which meshes are.
VkDeviceSize lightStaging(const LightTableDesc& desc) { return (desc.maxLights - desc.meshLights) * kLightBytes; }

// In the order of TableBuffer.
std::vector<BufferRequest> requestsOf(uint32_t framesInFlight, const LightTableDesc& desc) {
    const VkDeviceSize lights = std::max(desc.maxLights, 1u) * kLightBytes;
    const VkDeviceSize meshes = std::max(desc.maxMeshes, 1u) * sizeof(gpu::RsLightMesh);
    const VkDeviceSize means = std::max(desc.meshLights, 1u) * sizeof(gpu::vec3);
    const VkDeviceSize kept = desc.meshLights > 0 ? lightStaging(desc) : 0;
    const VkDeviceSize columns = aliasColumns(desc.maxLights), blocks = aliasBlocks(desc.maxLights);
    const VkBufferUsageFlags storage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
    const VkBufferUsageFlags filled = storage | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    const VkBufferUsageFlags copied = VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    const MemoryUse device = MemoryUse::DeviceOnly;
    std::vector<BufferRequest> requests = {{lights, filled, device, "lights 0"},
                                           {lights, filled, device, "lights 1"},
                                           {columns * sizeof(gpu::RsAliasEntry), storage, device, "light alias table"},
                                           {sizeof(gpu::RsTableState), filled, device, "light table state"},
                                           {columns * sizeof(gpu::uvec2), storage, device, "light excesses"},
                                           {columns * sizeof(gpu::uvec2), storage, device, "light deficits"},
                                           {blocks * sizeof(gpu::uvec4), storage, device, "light blocks"},
                                           {std::max(kept, kLightBytes), copied, device, "lights kept"},
                                           {meshes, filled, device, "light meshes"},
                                           {means, storage, device, "light texture means"},
                                           {treeBytes(desc), storage, device, "light tree"},
                                           {treeCountBytes(desc), storage, device, "light tree counts"}};
    for (uint32_t i = 0; i < framesInFlight; ++i)
        requests.push_back(
            {lightStaging(desc) + meshes, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, MemoryUse::HostWrite, "light staging"});
    return requests;
}

LightLimits limitsOf(const Context::Impl& c, const LightTableDesc& desc) noexcept {
    return {.first = desc.meshLights,
            .lights = desc.maxLights,
            .textures = c.ownsSceneLayout ? c.maxTextures : RS_LIGHT_NO_TEXTURE};
}

const char* checkDesc(const Device& device, const LightTableDesc& desc) noexcept {
    const MessageSink& sink = device.sink();
    if (desc.maxLights > kMaxLights) {
        refuse(sink, "restir: LightTableDesc::maxLights is %u, at most %u", desc.maxLights, kMaxLights);
        return "LightTableDesc::maxLights is too large";
    }
    if (desc.meshLights > desc.maxLights) {
        refuse(sink, "restir: LightTableDesc::meshLights is %u, maxLights %u", desc.meshLights, desc.maxLights);
        return "LightTableDesc::meshLights is above maxLights";
    }
    if (desc.maxMeshes > kMaxLights) {
        refuse(sink, "restir: LightTableDesc::maxMeshes is %u, at most %u", desc.maxMeshes, kMaxLights);
        return "LightTableDesc::maxMeshes is too large";
    }
    const uint32_t mostTexels = device.limits.maxStorageBufferRange / uint32_t(sizeof(gpu::RsEnvironmentTexel));
    if (desc.maxEnvironmentTexels > mostTexels) {
        refuse(sink, "restir: LightTableDesc::maxEnvironmentTexels is %u, this device takes %u", desc.maxEnvironmentTexels,
               mostTexels);
        return "LightTableDesc::maxEnvironmentTexels is too large";
    }
    return nullptr;
}

Status checkSlot(const LightTable::Impl& t, const char* call, uint32_t frameSlot) noexcept {
    if (frameSlot < t.context->framesInFlight) return Status::Ok;
    return refuse(t.device->sink(), "restir: LightTable::%s: frameSlot is %u, framesInFlight is %u", call, frameSlot,
                  t.context->framesInFlight);
}

Status checkRecord(const LightTable::Impl& t, VkCommandBuffer cmd, uint32_t frameSlot) noexcept {
    if (!cmd) return refuse(t.device->sink(), "restir: LightTable::record: cmd is null");
    if (Status s = checkSlot(t, "record", frameSlot); s != Status::Ok) return s;
    for (const auto& [pending, slot] : {std::pair(t.pendingLights, t.lightSlot), std::pair(t.pendingMeshes, t.meshSlot)})
        if (pending && slot != frameSlot)
            return refuse(t.device->sink(), "restir: LightTable::record: frameSlot is %u, the upload went to %u", frameSlot, slot);
    return Status::Ok;
}

Status findScene(const LightTable::Impl& t, const Scene* scene, VkDescriptorSet bridgeSet, VkDescriptorSet& set) noexcept {
    const MessageSink& sink = t.device->sink();
    set = bridgeSet;
    if (!t.context->ownsSceneLayout)
        return set ? Status::Ok : refuse(sink, "restir: LightTable::record: bridgeSet is null, but there are meshes");
    if (!scene) return refuse(sink, "restir: LightTable::record: scene is null, but there are meshes");
    if (Internals::of(*scene).context != t.context)
        return refuse(sink, "restir: LightTable::record: scene is of another Context");
    set = Internals::of(*scene).set;
    return Status::Ok;
}

void recordCopies(const LightTable::Impl& t, VkCommandBuffer cmd, bool newLights, bool newMeshes) noexcept {
    using enum TableBuffer;
    const Functions& f = t.device->functions;
    const VkBuffer lightStaging = t.buffers.buffer(t.stagingOf(t.lightSlot)), kept = t.buffer(Kept);
    if (VkBufferCopy lights{.dstOffset = t.meshLights * kLightBytes, .size = t.uploadBytes()}; lights.size > 0) {
        f.vkCmdCopyBuffer(cmd, newLights ? lightStaging : kept, t.current(), 1, &lights);
        lights.dstOffset = 0;
        if (newLights && t.meshLights > 0) f.vkCmdCopyBuffer(cmd, lightStaging, kept, 1, &lights);
    }
    if (t.meshes.count == 0 && t.meshLights > 0)   // else a pass writes them all
        f.vkCmdFillBuffer(cmd, t.current(), 0, std::min(t.meshLights, t.recorded.count) * kLightBytes, 0);
    const VkBufferCopy meshes{.srcOffset = t.meshOffset, .size = t.meshes.count * sizeof(gpu::RsLightMesh)};
    if (newMeshes && meshes.size > 0)
        f.vkCmdCopyBuffer(cmd, t.buffers.buffer(t.stagingOf(t.meshSlot)), t.buffer(Meshes), 1, &meshes);
}

}   // namespace

LightTable::Impl::~Impl() {
    if (pool) device->functions.vkDestroyDescriptorPool(device->info.device, pool, device->allocator());
}

LightTable::LightTable(std::unique_ptr<Impl> impl) noexcept : impl_(std::move(impl)) {}
LightTable::LightTable(LightTable&&) noexcept = default;
LightTable& LightTable::operator=(LightTable&&) noexcept = default;
LightTable::~LightTable() = default;

Result<LightTable> LightTable::create(const Context& context, const LightTableDesc& desc) noexcept {
    const Context::Impl& c = Internals::of(context);
    if (const char* wrong = checkDesc(c.device, desc)) return Error{Status::InvalidArgument, VK_SUCCESS, wrong};
    auto impl = std::make_unique<Impl>(desc, limitsOf(c, desc));
    impl->context = &c;
    impl->device = &c.device;
    impl->serial = ++c.lightTables;
    impl->meshOffset = lightStaging(desc);
    auto buffers = Buffers::create(c.device, requestsOf(c.framesInFlight, desc));
    if (!buffers) return buffers.error();
    impl->buffers = std::move(*buffers);
    auto environment = EnvironmentTable::create(c.device, desc.maxEnvironmentTexels);
    if (!environment) return environment.error();
    impl->environment = std::move(*environment);
    if (auto made = requireBuildPasses(*impl); !made) return made.error();
    if (VkResult vk = makeBuildSets(*impl); vk != VK_SUCCESS)
        return failure(c.device.sink(), Status::DeviceError, "allocating the light table's descriptor sets failed", vk);
    if (VkResult vk = impl->stopwatch.create(c.device, c.framesInFlight, kMaxTimedPasses); vk != VK_SUCCESS)
        return failure(c.device.sink(), Status::DeviceError, "creating the light table's query pool failed", vk);
    return LightTable(std::move(impl));
}

VkDeviceSize LightTable::memoryNeeded(const Context& context, const LightTableDesc& desc) noexcept {
    const Context::Impl& c = Internals::of(context);
    return Buffers::memoryNeeded(c.device, requestsOf(c.framesInFlight, desc)) +
           EnvironmentTable::memoryNeeded(c.device, desc.maxEnvironmentTexels);
}

Status LightTable::upload(uint32_t frameSlot, std::span<const Light> lights) noexcept {
    Impl& t = *impl_;
    const MessageSink& sink = t.device->sink();
    if (Status s = checkSlot(t, "upload", frameSlot); s != Status::Ok) return s;
    // Bad lights must not overwrite good ones that still wait in this slot.
    if (t.pendingLights && t.lightSlot == frameSlot)
        if (Status s = t.packer.pack(sink, lights, nullptr, t.uploaded); s != Status::Ok) return s;
    auto* staging = t.buffers.mapped<gpu::RsPackedLight>(t.stagingOf(frameSlot));
    if (Status s = t.packer.pack(sink, lights, staging, t.uploaded); s != Status::Ok) return s;
    t.pendingLights = true;
    t.lightSlot = frameSlot;
    return Status::Ok;
}

Status LightTable::uploadMeshes(uint32_t frameSlot, std::span<const LightMesh> meshes) noexcept {
    Impl& t = *impl_;
    if (Status s = checkSlot(t, "uploadMeshes", frameSlot); s != Status::Ok) return s;
    if (Status s = t.meshPacker.pack(t.device->sink(), meshes, t.meshes); s != Status::Ok) return s;
    const std::span<const gpu::RsLightMesh> list = t.meshPacker.list();
    auto* staging = t.buffers.mapped<uint8_t>(t.stagingOf(frameSlot)) + t.meshOffset;
    if (!list.empty()) std::memcpy(staging, list.data(), list.size_bytes());
    t.pendingMeshes = true;
    t.meshSlot = frameSlot;
    return Status::Ok;
}

Status LightTable::uploadEnvironment(const EnvironmentMap& map) noexcept {
    Impl& t = *impl_;
    if (Status s = t.environment.upload(t.device->sink(), map); s != Status::Ok) return s;
    t.packer.environmentHas(t.environment.luminance());
    return Status::Ok;
}

Status LightTable::record(VkCommandBuffer cmd, uint32_t frameSlot, const Scene* scene,
                          VkDescriptorSet bridgeSet) noexcept {
    Impl& t = *impl_;
    BuildInput input{.newMeshes = t.pendingMeshes};
    if (Status s = checkRecord(t, cmd, frameSlot); s != Status::Ok) return s;
    if (t.meshes.count > 0)
        if (Status s = findScene(t, scene, bridgeSet, input.scene); s != Status::Ok) return s;
    t.environment.record(*t.device, cmd);
    if (!t.pending() && t.meshes.count == 0) return Status::Ok;
    const bool newLights = t.pendingLights;
    t.pendingLights = t.pendingMeshes = false;
    ++t.generation;
    t.previousCount = t.recorded.count;
    t.recorded = t.uploaded;
    t.recorded.count = std::max(t.uploaded.count, t.meshes.lights);
    t.stopwatch.reset(frameSlot);
    if (t.recorded.count == 0) return Status::Ok;

    const Functions& f = t.device->functions;
    const VkPipelineStageFlags2 passes = t.device->passStages;
    constexpr VkPipelineStageFlags2 transfer = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
    constexpr VkAccessFlags2 wrote = VK_ACCESS_2_TRANSFER_WRITE_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;
    // The copies wait for the last build and the frames that still read these buffers, the build for the copies.
    memoryBarrier(f, cmd, {passes | transfer, wrote},
                  {transfer, VK_ACCESS_2_TRANSFER_READ_BIT | VK_ACCESS_2_TRANSFER_WRITE_BIT});
    recordCopies(t, cmd, newLights, input.newMeshes);
    f.vkCmdFillBuffer(cmd, t.buffer(TableBuffer::State), 0, VK_WHOLE_SIZE, 0);
    memoryBarrier(f, cmd, {passes | transfer, wrote},
                  {VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT});
    recordBuild(t, cmd, frameSlot, input);
    return Status::Ok;
}

LightBuffers LightTable::buffers() const noexcept {
    const Impl& t = *impl_;
    const gpu::uvec2 extent = t.environment.extent();
    return {.lights = t.current(),
            .alias = t.alias(),
            .environment = t.environment.buffer(),
            .tree = t.hasTree ? t.buffer(TableBuffer::Tree) : VK_NULL_HANDLE,
            .count = t.recorded.count,
            .environmentExtent = {extent.x, extent.y}};
}

std::span<const PassTiming> LightTable::timings(uint32_t frameSlot) noexcept { return impl_->stopwatch.read(frameSlot); }

}   // namespace restir
