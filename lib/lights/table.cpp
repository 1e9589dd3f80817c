#include <lights/table_impl.h>

#include <algorithm>

#include <device/barrier.h>
#include <device/internals.h>
#include <lights/build.h>
#include <restir/shared/light_table.h>

namespace restir {
namespace {

constexpr uint32_t kMaxLights = 1u << 20;
constexpr uint32_t kMaxTimedPasses = 8;
constexpr VkDeviceSize kLightBytes = sizeof(gpu::RsPackedLight);

// In the order of TableBuffer.
std::vector<BufferRequest> requestsOf(uint32_t framesInFlight, uint32_t maxLights) {
    const VkDeviceSize lights = std::max<VkDeviceSize>(maxLights, 1) * kLightBytes;
    const VkDeviceSize columns = aliasColumns(maxLights), blocks = aliasBlocks(maxLights);
    const VkBufferUsageFlags storage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
    const VkBufferUsageFlags filled = storage | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    const MemoryUse device = MemoryUse::DeviceOnly;
    std::vector<BufferRequest> requests = {{lights, filled, device, "lights 0"},
                                           {lights, filled, device, "lights 1"},
                                           {columns * sizeof(gpu::RsAliasEntry), storage, device, "light alias table"},
                                           {sizeof(gpu::RsTableState), filled, device, "light table state"},
                                           {columns * sizeof(gpu::uvec2), storage, device, "light excesses"},
                                           {columns * sizeof(gpu::uvec2), storage, device, "light deficits"},
                                           {blocks * sizeof(gpu::uvec4), storage, device, "light blocks"}};
    for (uint32_t i = 0; i < framesInFlight; ++i)
        requests.push_back({lights, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, MemoryUse::HostWrite, "light staging"});
    return requests;
}

LightLimits limitsOf(const Context::Impl& c, const LightTableDesc& desc) noexcept {
    return {.lights = desc.maxLights, .textures = c.ownsSceneLayout ? c.maxTextures : RS_LIGHT_NO_TEXTURE};
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
    if (desc.maxLights > kMaxLights) {
        refuse(c.device.sink(), "restir: LightTableDesc::maxLights is %u, at most %u", desc.maxLights, kMaxLights);
        return Error{Status::InvalidArgument, VK_SUCCESS, "LightTableDesc::maxLights is too large"};
    }
    auto impl = std::make_unique<Impl>(limitsOf(c, desc));
    impl->context = &c;
    impl->device = &c.device;
    impl->serial = ++c.lightTables;
    auto buffers = Buffers::create(c.device, requestsOf(c.framesInFlight, desc.maxLights));
    if (!buffers) return buffers.error();
    impl->buffers = std::move(*buffers);
    auto environment = EnvironmentTable::create(c.device, desc.maxEnvironmentTexels);
    if (!environment) return environment.error();
    impl->environment = std::move(*environment);
    if (VkResult vk = makeBuildSets(*impl); vk != VK_SUCCESS)
        return failure(c.device.sink(), Status::DeviceError, "allocating the light table's descriptor sets failed", vk);
    if (VkResult vk = impl->stopwatch.create(c.device, c.framesInFlight, kMaxTimedPasses); vk != VK_SUCCESS)
        return failure(c.device.sink(), Status::DeviceError, "creating the light table's query pool failed", vk);
    return LightTable(std::move(impl));
}

VkDeviceSize LightTable::memoryNeeded(const Context& context, const LightTableDesc& desc) noexcept {
    const Context::Impl& c = Internals::of(context);
    return Buffers::memoryNeeded(c.device, requestsOf(c.framesInFlight, desc.maxLights)) +
           EnvironmentTable::memoryNeeded(c.device, desc.maxEnvironmentTexels);
}

Status LightTable::upload(uint32_t frameSlot, std::span<const Light> lights) noexcept {
    Impl& t = *impl_;
    const MessageSink& sink = t.device->sink();
    if (frameSlot >= t.context->framesInFlight)
        return refuse(sink, "restir: LightTable::upload: frameSlot is %u, framesInFlight is %u", frameSlot,
                      t.context->framesInFlight);
    // Bad lights must not overwrite good ones that still wait in this slot.
    if (t.pending && t.uploadSlot == frameSlot)
        if (Status s = t.packer.pack(sink, lights, nullptr, t.uploaded); s != Status::Ok) return s;
    auto* staging = t.buffers.mapped<gpu::RsPackedLight>(t.stagingOf(frameSlot));
    if (Status s = t.packer.pack(sink, lights, staging, t.uploaded); s != Status::Ok) return s;
    t.pending = true;
    t.uploadSlot = frameSlot;
    return Status::Ok;
}

Status LightTable::uploadEnvironment(const EnvironmentMap& map) noexcept {
    Impl& t = *impl_;
    if (Status s = t.environment.upload(t.device->sink(), map); s != Status::Ok) return s;
    t.packer.environmentHas(t.environment.luminance());
    return Status::Ok;
}

Status LightTable::record(VkCommandBuffer cmd, uint32_t frameSlot) noexcept {
    Impl& t = *impl_;
    if (!cmd) return refuse(t.device->sink(), "restir: LightTable::record: cmd is null");
    if (t.pending && frameSlot != t.uploadSlot)
        return refuse(t.device->sink(), "restir: LightTable::record: frameSlot is %u, the upload went to %u", frameSlot,
                      t.uploadSlot);
    t.environment.record(t.device->functions, cmd);
    if (!t.pending) return Status::Ok;
    t.pending = false;
    ++t.generation;
    t.previousCount = t.recorded.count;
    t.recorded = t.uploaded;
    t.stopwatch.reset(frameSlot);
    if (t.recorded.count == 0) return Status::Ok;

    const Functions& f = t.device->functions;
    constexpr VkPipelineStageFlags2 compute = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
    constexpr VkPipelineStageFlags2 transfer = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
    constexpr VkAccessFlags2 wrote = VK_ACCESS_2_TRANSFER_WRITE_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;
    // The copy waits for the last build and the frames that still read these buffers, the build for the copy.
    memoryBarrier(f, cmd, {compute | transfer, wrote}, {transfer, VK_ACCESS_2_TRANSFER_WRITE_BIT});
    const VkBufferCopy lights{.size = t.recorded.count * kLightBytes};
    f.vkCmdCopyBuffer(cmd, t.buffers.buffer(t.stagingOf(frameSlot)), t.current(), 1, &lights);
    f.vkCmdFillBuffer(cmd, t.buffer(TableBuffer::State), 0, VK_WHOLE_SIZE, 0);
    memoryBarrier(f, cmd, {compute | transfer, wrote},
                  {compute, VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT});
    recordBuild(t, cmd, frameSlot);
    return Status::Ok;
}

std::span<const PassTiming> LightTable::timings(uint32_t frameSlot) noexcept { return impl_->stopwatch.read(frameSlot); }

}   // namespace restir
