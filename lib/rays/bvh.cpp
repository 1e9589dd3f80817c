#include <rays/bvh_impl.h>

#include <algorithm>
#include <cmath>

#include <device/barrier.h>
#include <device/internals.h>
#include <device/label.h>
#include <rays/mesh_impl.h>
#include <rays/place.h>

namespace restir {
namespace {

constexpr VkDeviceSize kNodeBytes = sizeof(gpu::RsBvhNode), kCornerBytes = sizeof(gpu::RsBvhCorner),
                       kInstanceBytes = sizeof(gpu::RsBvhInstance);
constexpr uint64_t kMaxNodes = uint64_t(1) << 30;   // two entries each, and a word has 31 bits for a node

BvhSizes sizesOf(const BvhDesc& desc) noexcept {
    BvhSizes sizes{.instances = desc.maxInstances};
    for (const BvhMesh& mesh : desc.meshes) {
        sizes.meshNodes += Internals::of(mesh).nodes.size();
        sizes.triangles += Internals::of(mesh).corners[0].size();
    }
    return sizes;
}

// In the order of BvhBuffer. Every stream has an element, so that its binding is.
std::vector<BufferRequest> requestsOf(uint32_t framesInFlight, const BvhSizes& sizes) {
    const VkBufferUsageFlags filled = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    const MemoryUse device = MemoryUse::DeviceOnly;
    const VkDeviceSize corners = std::max<uint64_t>(sizes.triangles, 1) * kCornerBytes;
    const VkDeviceSize instances = std::max<uint64_t>(sizes.instances, 1);
    std::vector<BufferRequest> requests = {
        {std::max<uint64_t>(sizes.nodes(), 1) * kNodeBytes, filled, device, "BVH nodes"},
        {corners, filled, device, "BVH corners 0"},
        {corners, filled, device, "BVH corners 1"},
        {corners, filled, device, "BVH corners 2"},
        {2 * instances * kInstanceBytes, filled, device, "BVH instances"}};
    for (uint32_t i = 0; i < framesInFlight; ++i)
        requests.push_back({instances * (kNodeBytes + kInstanceBytes), VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                            MemoryUse::HostWrite, "BVH staging"});
    return requests;
}

// Nodes, then each corner's stream.
BufferRequest meshStagingOf(const BvhSizes& sizes) noexcept {
    const VkDeviceSize bytes = sizes.meshNodes * kNodeBytes + 3 * sizes.triangles * kCornerBytes;
    return {std::max<VkDeviceSize>(bytes, 16), VK_BUFFER_USAGE_TRANSFER_SRC_BIT, MemoryUse::HostWrite,
            "BVH mesh staging"};
}

Status checkDesc(const Context::Impl& c, const BvhDesc& desc, const BvhSizes& sizes) noexcept {
    const MessageSink& sink = c.device.sink();
    if (c.rays != RayBackend::Software)
        return refuse(
            sink,
            "restir: Bvh is what RayBackend::Software traces, this Context has another ContextDesc::rays");
    const uint64_t range = c.device.limits.maxStorageBufferRange;
    const uint64_t instances = std::min<uint64_t>(range / (2 * kInstanceBytes), RS_BVH_INDEX / 2);
    if (sizes.instances > instances)
        return refuse(sink, "restir: BvhDesc::maxInstances is %u, this device takes %llu", desc.maxInstances,
                      static_cast<unsigned long long>(instances));
    const uint64_t nodes = std::min(range / kNodeBytes, kMaxNodes) - 2 * sizes.topNodes();
    if (sizes.meshNodes > nodes)
        return refuse(sink,
                      "restir: BvhDesc::meshes have %llu nodes, this device takes %llu beside %u instances",
                      static_cast<unsigned long long>(sizes.meshNodes),
                      static_cast<unsigned long long>(nodes), desc.maxInstances);
    const uint64_t triangles = std::min<uint64_t>(range / kCornerBytes, RS_BVH_INDEX);
    if (sizes.triangles > triangles)
        return refuse(sink, "restir: BvhDesc::meshes have %llu triangles, this device takes %llu",
                      static_cast<unsigned long long>(sizes.triangles),
                      static_cast<unsigned long long>(triangles));
    return Status::Ok;
}

// Where a tree's parts lie in the streams.
struct Place {
    uint32_t nodes, leaves;

    uint32_t word(uint32_t word) const noexcept {
        if (word == RS_BVH_EMPTY) return word;
        return word + (word & RS_BVH_LEAF ? leaves : nodes);
    }
    void copy(std::span<const gpu::RsBvhNode> from, gpu::RsBvhNode* to) const noexcept {
        for (gpu::RsBvhNode node : from) {
            node.child0 = word(node.child0);
            node.child1 = word(node.child1);
            node.parent += 2 * nodes;
            *to++ = node;
        }
    }
};

void stageMeshes(Bvh::Impl& b, std::span<const BvhMesh> meshes) noexcept {
    auto* nodes = b.meshStaging.mapped<gpu::RsBvhNode>(0);
    auto* corners = reinterpret_cast<gpu::RsBvhCorner*>(nodes + b.sizes.meshNodes);
    uint32_t firstNode = 0, firstTriangle = 0;
    for (const BvhMesh& each : meshes) {
        const BvhMesh::Impl& mesh = Internals::of(each);
        const Place place{uint32_t(2 * b.sizes.topNodes()) + firstNode, firstTriangle};
        place.copy(mesh.nodes, nodes + firstNode);
        for (size_t i = 0; i < 3; ++i)
            std::ranges::copy(mesh.corners[i], corners + i * b.sizes.triangles + firstTriangle);
        b.meshes.push_back({place.word(mesh.root), mesh.box});
        firstNode += uint32_t(mesh.nodes.size());
        firstTriangle += uint32_t(mesh.corners[0].size());
    }
}

Status checkRecord(const Bvh::Impl& b, VkCommandBuffer cmd, uint32_t frameSlot,
                   std::span<const BvhInstance> instances) noexcept {
    const MessageSink& sink = b.device->sink();
    if (!cmd) return refuse(sink, "restir: Bvh::record: cmd is null");
    if (frameSlot >= b.context->framesInFlight)
        return refuse(sink, "restir: Bvh::record: frameSlot is %u, framesInFlight is %u", frameSlot,
                      b.context->framesInFlight);
    if (instances.size() > b.sizes.instances)
        return refuse(sink, "restir: Bvh::record: there are %zu instances, BvhDesc::maxInstances is %llu",
                      instances.size(), static_cast<unsigned long long>(b.sizes.instances));
    for (size_t i = 0; i < instances.size(); ++i) {
        if (instances[i].mesh >= b.meshes.size())
            return refuse(sink, "restir: BvhInstance::mesh of instance %zu is %u, BvhDesc::meshes has %zu", i,
                          instances[i].mesh, b.meshes.size());
        for (const auto& row : instances[i].worldFromObject)
            for (float value : row)
                if (!std::isfinite(value))
                    return refuse(sink, "restir: BvhInstance::worldFromObject of instance %zu is not finite",
                                  i);
    }
    return Status::Ok;
}

void buildTop(Bvh::Impl& b, std::span<const BvhInstance> instances) noexcept {
    b.placed.clear();
    b.boxes.clear();
    for (const BvhInstance& instance : instances) {
        const Bvh::Impl::Mesh& mesh = b.meshes[instance.mesh];
        gpu::RsBvhInstance placed{.root = mesh.root};
        Box box = Box::empty();
        if (!placeInstance(instance, mesh.box, placed, box)) continue;
        b.placed.push_back(placed);
        b.boxes.push_back(box);
    }
    buildTree(b.boxes, 1, RS_BVH_INSTANCE, b.tree);
}

void copy(const Functions& f, VkCommandBuffer cmd, VkBuffer from, VkDeviceSize offset, VkBuffer to,
          VkDeviceSize at, VkDeviceSize bytes) noexcept {
    const VkBufferCopy region{offset, at, bytes};
    if (bytes > 0) f.vkCmdCopyBuffer(cmd, from, to, 1, &region);
}

void recordMeshes(const Bvh::Impl& b, VkCommandBuffer cmd) noexcept {
    const Functions& f = b.device->functions;
    const VkBuffer staging = b.meshStaging.buffer(0);
    const VkDeviceSize nodes = b.sizes.meshNodes * kNodeBytes, corners = b.sizes.triangles * kCornerBytes;
    copy(f, cmd, staging, 0, b.buffer(BvhBuffer::Nodes), 2 * b.sizes.topNodes() * kNodeBytes, nodes);
    for (uint32_t i = 0; i < 3; ++i)
        copy(f, cmd, staging, nodes + i * corners, b.buffer(BvhBuffer(uint32_t(BvhBuffer::Corners0) + i)), 0,
             corners);
}

// The tree over the instances as generation `b.generation`.
void recordTop(Bvh::Impl& b, VkCommandBuffer cmd, uint32_t slot) noexcept {
    const Functions& f = b.device->functions;
    const uint64_t parity = b.generation % 2;
    const Place place{uint32_t(parity * b.sizes.topNodes()), uint32_t(parity * b.sizes.instances)};
    auto* nodes = b.buffers.mapped<gpu::RsBvhNode>(b.stagingOf(slot));
    auto* instances = reinterpret_cast<gpu::RsBvhInstance*>(nodes + b.tree.nodes.size());
    place.copy(b.tree.nodes, nodes);
    for (uint32_t i : b.tree.order) *instances++ = b.placed[i];
    b.roots[parity] = place.word(b.tree.root);
    const VkBuffer staging = b.buffers.buffer(b.stagingOf(slot));
    const VkDeviceSize nodeBytes = b.tree.nodes.size() * kNodeBytes;
    copy(f, cmd, staging, 0, b.buffer(BvhBuffer::Nodes), place.nodes * kNodeBytes, nodeBytes);
    copy(f, cmd, staging, nodeBytes, b.buffer(BvhBuffer::Instances), place.leaves * kInstanceBytes,
         b.placed.size() * kInstanceBytes);
}

}   // namespace

Bvh::Bvh(std::unique_ptr<Impl> impl) noexcept : impl_(std::move(impl)) {}
Bvh::Bvh(Bvh&&) noexcept = default;
Bvh& Bvh::operator=(Bvh&&) noexcept = default;
Bvh::~Bvh() = default;

Result<Bvh> Bvh::create(const Context& context, const BvhDesc& desc) noexcept {
    const Context::Impl& c = Internals::of(context);
    const BvhSizes sizes = sizesOf(desc);
    if (Status s = checkDesc(c, desc, sizes); s != Status::Ok)
        return Error{s, VK_SUCCESS, "BvhDesc is invalid"};
    auto impl = std::make_unique<Impl>();
    impl->context = &c;
    impl->device = &c.device;
    impl->serial = ++c.bvhs;
    impl->sizes = sizes;
    auto buffers = Buffers::create(c.device, requestsOf(c.framesInFlight, sizes));
    if (!buffers) return buffers.error();
    impl->buffers = std::move(*buffers);
    const BufferRequest staging = meshStagingOf(sizes);
    auto meshStaging = Buffers::create(c.device, {&staging, 1});
    if (!meshStaging) return meshStaging.error();
    impl->meshStaging = std::move(*meshStaging);
    stageMeshes(*impl, desc.meshes);
    return Bvh(std::move(impl));
}

VkDeviceSize Bvh::memoryNeeded(const Context& context, const BvhDesc& desc) noexcept {
    const Context::Impl& c = Internals::of(context);
    const BvhSizes sizes = sizesOf(desc);
    const BufferRequest staging = meshStagingOf(sizes);
    return Buffers::memoryNeeded(c.device, requestsOf(c.framesInFlight, sizes)) +
           Buffers::memoryNeeded(c.device, {&staging, 1});
}

Status Bvh::record(VkCommandBuffer cmd, uint32_t frameSlot, std::span<const BvhInstance> instances) noexcept {
    Impl& b = *impl_;
    if (Status s = checkRecord(b, cmd, frameSlot, instances); s != Status::Ok) return s;
    buildTop(b, instances);
    ++b.generation;
    const Functions& f = b.device->functions;
    const Label label(f, cmd, "restir BVH");
    constexpr VkPipelineStageFlags2 compute = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                                    copy = VK_PIPELINE_STAGE_2_COPY_BIT;
    constexpr VkAccessFlags2 wrote = VK_ACCESS_2_TRANSFER_WRITE_BIT;
    // Behind the frames that still read the generation before the last one.
    memoryBarrier(f, cmd, {compute | copy, wrote}, {copy, wrote});
    if (b.meshesPending) recordMeshes(b, cmd);
    b.meshesPending = false;
    recordTop(b, cmd, frameSlot);
    memoryBarrier(f, cmd, {copy, wrote}, {compute, VK_ACCESS_2_SHADER_STORAGE_READ_BIT});
    return Status::Ok;
}

BvhBuffers Bvh::buffers() const noexcept {
    using enum BvhBuffer;
    const Impl& b = *impl_;
    return {.nodes = b.buffer(Nodes),
            .corners = {b.buffer(Corners0), b.buffer(Corners1), b.buffer(Corners2)},
            .instances = b.buffer(Instances),
            .root = b.root(),
            .previousRoot = b.previousRoot()};
}

void Bvh::releaseStaging() noexcept {
    if (!impl_->meshesPending) impl_->meshStaging = {};
}

}   // namespace restir
