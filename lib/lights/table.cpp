#include <lights/table_impl.h>

#include <algorithm>
#include <cstring>

#include <device/barrier.h>
#include <device/internals.h>
#include <frame/context_impl.h>

namespace restir {
namespace {

// Buffers of a table: two generations of lights, the alias table of the newer, and staging for each frame slot.
enum Slot : size_t { kLights0, kLights1, kAlias, kStaging };

constexpr uint32_t kMaxLights = 1u << 20;
constexpr VkDeviceSize kLightBytes = sizeof(gpu::RsPackedLight);

std::vector<BufferRequest> requestsOf(uint32_t framesInFlight, uint32_t maxLights) {
    const VkDeviceSize lights = std::max<VkDeviceSize>(maxLights, 1) * kLightBytes;
    const VkDeviceSize alias = std::max<VkDeviceSize>(maxLights, 1) * sizeof(gpu::RsAliasEntry);
    const VkBufferUsageFlags usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    std::vector<BufferRequest> requests = {{lights, usage, MemoryUse::DeviceOnly, "lights 0"},
                                           {lights, usage, MemoryUse::DeviceOnly, "lights 1"},
                                           {alias, usage, MemoryUse::DeviceOnly, "light alias table"}};
    for (uint32_t i = 0; i < framesInFlight; ++i)
        requests.push_back({lights + alias, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, MemoryUse::HostWrite, "light staging"});
    return requests;
}

}   // namespace

VkBuffer LightTable::Impl::current() const noexcept { return buffers.buffer(generation % 2 ? kLights1 : kLights0); }
VkBuffer LightTable::Impl::previous() const noexcept { return buffers.buffer(generation % 2 ? kLights0 : kLights1); }
VkBuffer LightTable::Impl::alias() const noexcept { return buffers.buffer(kAlias); }

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
    auto impl = std::make_unique<Impl>();
    impl->context = &c;
    impl->device = &c.device;
    impl->serial = ++c.lightTables;
    impl->framesInFlight = c.framesInFlight;
    impl->maxLights = desc.maxLights;
    auto buffers = Buffers::create(c.device, requestsOf(c.framesInFlight, desc.maxLights));
    if (!buffers) return buffers.error();
    impl->buffers = std::move(*buffers);
    return LightTable(std::move(impl));
}

VkDeviceSize LightTable::memoryNeeded(const Context& context, const LightTableDesc& desc) noexcept {
    const Context::Impl& c = Internals::of(context);
    return Buffers::memoryNeeded(c.device, requestsOf(c.framesInFlight, desc.maxLights));
}

Status LightTable::upload(uint32_t frameSlot, std::span<const Light> lights) noexcept {
    Impl& t = *impl_;
    if (frameSlot >= t.framesInFlight)
        return refuse(t.device->sink(), "restir: LightTable::upload: frameSlot is %u, framesInFlight is %u", frameSlot,
                      t.framesInFlight);
    const LightLimits limits{.lights = t.maxLights,
                             .textures = t.context->ownsSceneLayout ? t.context->maxTextures : RS_LIGHT_NO_TEXTURE};
    if (Status s = packLights(t.device->sink(), limits, lights, t.packed); s != Status::Ok) return s;
    auto* staging = t.buffers.mapped<uint8_t>(kStaging + frameSlot);
    const size_t lightBytes = t.packed.lights.size() * kLightBytes;
    if (!t.packed.alias.empty()) {
        std::memcpy(staging, t.packed.lights.data(), lightBytes);
        std::memcpy(staging + lightBytes, t.packed.alias.data(), t.packed.alias.size() * sizeof(gpu::RsAliasEntry));
    }
    t.uploaded = true;
    t.uploadSlot = frameSlot;
    return Status::Ok;
}

Status LightTable::record(VkCommandBuffer cmd, uint32_t frameSlot) noexcept {
    Impl& t = *impl_;
    if (!cmd) return refuse(t.device->sink(), "restir: LightTable::record: cmd is null");
    if (!t.uploaded) return Status::Ok;
    if (frameSlot != t.uploadSlot)
        return refuse(t.device->sink(), "restir: LightTable::record: frameSlot is %u, the upload went to %u", frameSlot,
                      t.uploadSlot);
    t.uploaded = false;
    ++t.generation;
    t.previousCount = t.count;
    t.count = uint32_t(t.packed.alias.size());
    t.textures = t.packed.textures;

    const Functions& f = t.device->functions;
    const VkPipelineStageFlags2 compute = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, copy = VK_PIPELINE_STAGE_2_COPY_BIT;
    // Copies wait for the frames that still read these buffers, readers wait for the copies.
    memoryBarrier(f, cmd, {compute | copy, VK_ACCESS_2_TRANSFER_WRITE_BIT}, {copy, VK_ACCESS_2_TRANSFER_WRITE_BIT});
    const VkBuffer staging = t.buffers.buffer(kStaging + frameSlot);
    if (t.count > 0) {
        const VkBufferCopy lights{.size = t.packed.lights.size() * kLightBytes};
        f.vkCmdCopyBuffer(cmd, staging, t.current(), 1, &lights);
        const VkBufferCopy alias{.srcOffset = lights.size, .size = t.packed.alias.size() * sizeof(gpu::RsAliasEntry)};
        f.vkCmdCopyBuffer(cmd, staging, t.alias(), 1, &alias);
    }
    memoryBarrier(f, cmd, {copy, VK_ACCESS_2_TRANSFER_WRITE_BIT}, {compute, VK_ACCESS_2_SHADER_STORAGE_READ_BIT});
    return Status::Ok;
}

}   // namespace restir
