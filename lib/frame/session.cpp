#include <frame/session_impl.h>

#include <algorithm>
#include <cmath>

#include <device/internals.h>
#include <frame/check.h>
#include <frame/layouts.h>

namespace restir {
namespace {

// Bytes per pixel of each per-pixel stream; elements of at most 16 bytes keep 4K inside the storage buffer
// range that Vulkan guarantees.
constexpr VkDeviceSize kSurfaceBytes = 16, kMoreBytes = 8, kSurfaceFrameBytes = 8;
constexpr VkDeviceSize kGiStreamBytes = sizeof(gpu::RsGiReservoir) / RS_GI_STREAMS;

// The targets of a pixel's own sample and of its partners', two bytes each, in whole words
// (passes/notes.glsl).
constexpr VkDeviceSize noteBytes(const SessionDesc& desc) noexcept {
    return desc.pairedNeighbours == 0 ? 0 : 4 * (desc.pairedNeighbours / 2 + 1);
}

Status checkDesc(const Context::Impl& c, const SessionDesc& desc) noexcept {
    const VkExtent2D e = desc.maxExtent;
    if (e.width == 0 || e.height == 0)
        return refuse(c.device.sink(), "restir: SessionDesc::maxExtent is %u x %u", e.width, e.height);
    if (desc.pairedNeighbours > kMaxNeighbours)
        return refuse(c.device.sink(), "restir: SessionDesc::pairedNeighbours is %u, must be in [0, %u]",
                      desc.pairedNeighbours, kMaxNeighbours);
    const VkDeviceSize pixels =
        c.device.limits.maxStorageBufferRange / std::max(kSurfaceBytes, noteBytes(desc));
    if (VkDeviceSize(e.width) * e.height > pixels)
        return refuse(c.device.sink(),
                      "restir: SessionDesc::maxExtent is %u x %u, this device takes %llu pixels", e.width,
                      e.height, static_cast<unsigned long long>(pixels));
    if (VkDeviceSize(desc.rayLogCapacity) * sizeof(gpu::RsLoggedRay) > c.device.limits.maxStorageBufferRange)
        return refuse(c.device.sink(),
                      "restir: SessionDesc::rayLogCapacity is %u, this device takes %llu rays",
                      desc.rayLogCapacity,
                      static_cast<unsigned long long>(c.device.limits.maxStorageBufferRange /
                                                      sizeof(gpu::RsLoggedRay)));
    return Status::Ok;
}

VkResult makeSets(Session::Impl& s) noexcept {
    const Context::Impl& c = *s.context;
    const Functions& f = c.device.functions;
    std::vector<VkDescriptorPoolSize> sizes;
    for (uint32_t i = 0; i < RS_BIND_COUNT; ++i)
        if (isBound(i, c.rays)) sizes.push_back({bindingType(i), bindingCount(i) * c.framesInFlight});
    const VkDescriptorPoolCreateInfo poolInfo{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                                              .maxSets = c.framesInFlight,
                                              .poolSizeCount = uint32_t(sizes.size()),
                                              .pPoolSizes = sizes.data()};
    VkResult vk = orNull(
        f.vkCreateDescriptorPool(c.device.info.device, &poolInfo, c.device.allocator(), &s.pool), s.pool);
    if (vk != VK_SUCCESS) return vk;
    const std::vector<VkDescriptorSetLayout> layouts(c.framesInFlight, c.frameLayout);
    s.sets.resize(c.framesInFlight);
    const VkDescriptorSetAllocateInfo info{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
                                           .descriptorPool = s.pool,
                                           .descriptorSetCount = c.framesInFlight,
                                           .pSetLayouts = layouts.data()};
    vk = f.vkAllocateDescriptorSets(c.device.info.device, &info, s.sets.data());
    if (vk != VK_SUCCESS) return vk;
    for (VkDescriptorSet set : s.sets)
        c.device.name(VK_OBJECT_TYPE_DESCRIPTOR_SET, handleValue(set), "frame");
    return VK_SUCCESS;
}

}   // namespace

std::vector<BufferRequest> sessionRequests(const Context::Impl& c, const SessionDesc& desc) {
    const VkDeviceSize pixels = VkDeviceSize(desc.maxExtent.width) * desc.maxExtent.height;
    const VkBufferUsageFlags storage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
    const VkBufferUsageFlags counted =
        storage | VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    const MemoryUse device = MemoryUse::DeviceOnly;
    std::vector<BufferRequest> requests = {
        {pixels * kSurfaceBytes, storage, device, "surfaces 0"},
        {pixels * kSurfaceBytes, storage, device, "surfaces 1"},
        {pixels * kMoreBytes, storage, device, "surface materials 0"},
        {pixels * kMoreBytes, storage, device, "surface materials 1"},
        {pixels * kSurfaceFrameBytes, storage, device, "surface motion and emission"},
        {pixels * sizeof(gpu::RsReservoir), storage, device, "reservoirs A"},
        {pixels * sizeof(gpu::RsReservoir), storage, device, "reservoirs B"},
        {sizeof(gpu::RsCounters), counted, device, "counters"},
        {std::max(desc.rayLogCapacity, 1u) * sizeof(gpu::RsLoggedRay), counted, device, "ray log"},
        {std::max(pixels * noteBytes(desc), VkDeviceSize{4}), storage, device, "partners' targets"},
    };
    for (const char* name : {"indirect vertices A", "indirect surfaces A", "indirect light A",
                             "indirect vertices B", "indirect surfaces B", "indirect light B"})
        requests.push_back({desc.indirect ? pixels * kGiStreamBytes : kGiStreamBytes, storage, device, name});
    for (uint32_t i = 0; i < c.framesInFlight; ++i) {
        requests.push_back({sizeof(gpu::RsFrame), VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, MemoryUse::HostWrite,
                            "frame constants"});
        requests.push_back({sizeof(gpu::RsCounters), VK_BUFFER_USAGE_TRANSFER_DST_BIT, MemoryUse::HostRead,
                            "counter readback"});
    }
    return requests;
}

Session::Session(std::unique_ptr<Impl> impl) noexcept : impl_(std::move(impl)) {}
Session::Session(Session&&) noexcept = default;
Session& Session::operator=(Session&&) noexcept = default;
Session::~Session() = default;

Session::Impl::~Impl() {
    const Functions& f = device().functions;
    if (pool) f.vkDestroyDescriptorPool(device().info.device, pool, device().allocator());
}

Result<Session> Session::create(const Context& context, const SessionDesc& desc) noexcept {
    const Context::Impl& c = Internals::of(context);
    if (Status s = checkDesc(c, desc); s != Status::Ok) return Error{s, VK_SUCCESS, "SessionDesc is invalid"};
    auto impl = std::make_unique<Impl>();
    impl->context = &c;
    impl->desc = desc;
    const std::vector<BufferRequest> requests = sessionRequests(c, desc);
    auto buffers = Buffers::create(c.device, requests);
    if (!buffers) return buffers.error();
    impl->buffers = std::move(*buffers);
    for (size_t i = 0; i < requests.size(); ++i) {
        const auto buffer = SessionBuffer(i);
        const bool notes = buffer == SessionBuffer::Notes && desc.pairedNeighbours > 0;
        const bool paths =
            buffer >= SessionBuffer::GiReservoirs0 && buffer <= SessionBuffer::GiReservoirsLast && desc.indirect;
        impl->report.push_back(
            {requests[i].name, requests[i].size, buffer < SessionBuffer::Counters || notes || paths});
    }
    if (VkResult vk = makeSets(*impl); vk != VK_SUCCESS)
        return failure(c.device.sink(), Status::DeviceError, "allocating the frames' descriptor sets failed",
                       vk);
    impl->counted.resize(c.framesInFlight);
    if (VkResult vk = impl->stopwatch.create(c.device, c.framesInFlight, kMaxTimedPasses); vk != VK_SUCCESS)
        return failure(c.device.sink(), Status::DeviceError, "creating the query pool failed", vk);
    return Session(std::move(impl));
}

VkDeviceSize Session::memoryNeeded(const Context& context, const SessionDesc& desc) noexcept {
    const Context::Impl& c = Internals::of(context);
    return Buffers::memoryNeeded(c.device, sessionRequests(c, desc));
}

namespace {

PlanInput withoutHistory(const FrameInput& frame) noexcept {
    return {.extent = frame.extent,
            .gradient = frame.output.gradient != VK_NULL_HANDLE,
            .indirectLobes = frame.output.indirectDiffuse || frame.output.indirectSpecular};
}

}   // namespace

Result<std::span<const PassInfo>> Session::plan(const FrameInput& frame, const Settings& settings) noexcept {
    Impl& s = *impl_;
    if (Status status = checkFrame(s, frame, settings); status != Status::Ok)
        return Error{status, VK_SUCCESS, "FrameInput or Settings is invalid"};
    s.preparedScene = VK_NULL_HANDLE;   // its list is gone
    PlanInput input = withoutHistory(frame);
    input.history = historyUsable(s, frame, settings);
    input.historyIn = s.history.reservoirs;
    input.giHistory = giHistoryUsable(s, frame, settings);
    input.giHistoryIn = s.history.giReservoirs;
    s.plan = makePlan(input, settings);
    return std::span<const PassInfo>(s.plan.passes);
}

Result<bool> requirePasses(const Context::Impl& context, const Plan& plan) noexcept {
    for (const PassInfo& pass : plan.passes)
        if (auto made = context.pipelines.require(pass.name); !made) return made;
    return true;
}

Status Session::makePipelines(const FrameInput& frame, const Settings& settings) noexcept {
    const Impl& s = *impl_;
    if (Status status = checkSettings(s, frame.extent, settings); status != Status::Ok) return status;
    PlanInput input = withoutHistory(frame);
    for (bool history : {false, true}) {
        input.history = input.giHistory = history;
        if (auto made = requirePasses(*s.context, makePlan(input, settings)); !made) return made.error().status;
    }
    return Status::Ok;
}

std::span<const PassTiming> Session::timings(uint32_t frameSlot) noexcept {
    return impl_->stopwatch.read(frameSlot);
}

Counters Session::counters(uint32_t frameSlot) const noexcept {
    if (frameSlot >= impl_->counted.size() || !impl_->counted[frameSlot]) return {};
    const auto* c = impl_->buffers.mapped<const gpu::RsCounters>(impl_->readbackOf(frameSlot));
    return {.rays = c->rays,
            .rejectedWeights = c->rejectedWeights,
            .loggedRays = std::min(c->loggedRays, impl_->desc.rayLogCapacity)};
}

std::span<const BufferInfo> Session::memory() const noexcept { return impl_->report; }

VkBuffer Session::rayLog() const noexcept {
    return impl_->desc.rayLogCapacity ? impl_->buffer(SessionBuffer::RayLog) : VK_NULL_HANDLE;
}

Scope Session::inputScope(RayBackend rays) noexcept {
    VkAccessFlags2 access =
        VK_ACCESS_2_SHADER_SAMPLED_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;
    if (rays == RayBackend::RayQuery) access |= VK_ACCESS_2_ACCELERATION_STRUCTURE_READ_BIT_KHR;
    // The same of ray generation shaders only; compute shaders have no such access without ray query.
    if (rays == RayBackend::Pipeline) access |= VK_ACCESS_2_MEMORY_READ_BIT;
    return {passStages(rays), access};
}

Scope Session::outputScope(RayBackend rays) noexcept {
    return {passStages(rays), VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT};
}

Scope Session::passScope(RayBackend rays) noexcept {
    return {passStages(rays), VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT};
}

}   // namespace restir
