#include "gpu/built_table.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <map>
#include <memory>
#include <string>

#include <restir/context.h>

#include "common/gpu_memory.h"
#include "support/gpu.h"

namespace tests {
namespace {

using samples::Buffer;

constexpr uint32_t kSlots = 2;

// A host's allocator that lets the SDK's buffers be read.
std::map<std::string, std::unique_ptr<Buffer>> buffers;

VkResult acquire(void*, const restir::BufferRequest& request, restir::BufferGrant& grant) {
    using samples::MemoryKind;
    const MemoryKind kind =
        request.use == restir::MemoryUse::DeviceOnly ? MemoryKind::Gpu : MemoryKind::Upload;
    auto buffer = std::make_unique<Buffer>(
        gpu(),
        samples::BufferDesc{
            .size = request.size, .usage = request.usage | VK_BUFFER_USAGE_TRANSFER_SRC_BIT, .memory = kind});
    grant = {.buffer = buffer->handle(), .mapped = buffer->mapped()};
    std::string name = request.name;
    while (buffers.contains(name)) name += "+";
    buffers[name] = std::move(buffer);
    return VK_SUCCESS;
}

void release(void*, const restir::BufferGrant& grant) {
    std::erase_if(buffers, [&](const auto& entry) { return entry.second->handle() == grant.buffer; });
}

restir::Context& context() {
    static restir::Context context = [] {
        restir::ContextDesc desc{
            .device = gpu().sdkInfo(),
            .rays = gpu().bestRays(),
            .pipelines = restir::PipelineCreation::OnDemand,
            .framesInFlight = kSlots,
            .queueFamily = gpu().queueFamily()};
        desc.device.memory = {.acquire = acquire, .release = release};
        return gpu().require(restir::Context::create(desc), "Context");
    }();
    return context;
}

template <class T>
std::vector<T> read(const std::string& name, size_t count) {
    std::vector<T> values(count);
    const VkDeviceSize bytes = count * sizeof(T);
    if (bytes == 0) return values;
    const Buffer readback(
        gpu(),
        {.size = bytes, .usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT, .memory = samples::MemoryKind::Readback});
    gpu().submitAndWait([&](VkCommandBuffer cmd) {
        samples::memoryBarrier(cmd,
                               {VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT},
                               {VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_READ_BIT});
        const VkBufferCopy all{.size = bytes};
        vkCmdCopyBuffer(cmd, buffers.at(name)->handle(), readback.handle(), 1, &all);
        samples::memoryBarrier(cmd, {VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT},
                               {VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT});
    });
    std::memcpy(values.data(), readback.mapped(), bytes);
    return values;
}

}   // namespace

BuiltTable build(std::span<const restir::Light> lights, uint32_t maxLights, uint32_t times) {
    uint32_t count = 0;
    for (const restir::Light& light : lights) count = std::max(count, light.id + 1);
    auto table = gpu().require(
        restir::LightTable::create(context(), {.maxLights = std::max(maxLights, count)}), "LightTable");
    gpu().submitAndWait([&](VkCommandBuffer cmd) {
        for (uint32_t i = 0; i < times; ++i) {
            gpu().check(table.upload(i % kSlots, lights), "LightTable::upload");
            gpu().check(table.record(cmd, i % kSlots), "LightTable::record");
        }
    });
    const size_t columns = count ? std::bit_ceil(std::max(count, 2u)) : 0;
    return {read<restir::gpu::RsPackedLight>(times % 2 ? "lights 1" : "lights 0", count),
            read<restir::gpu::RsAliasEntry>("light alias table", columns),
            read<restir::gpu::uvec4>("light tree", 3 * columns)};
}

MeshTable::MeshTable(const restir::SceneDesc& scene, const restir::LightTableDesc& desc)
    : desc_(desc),
      scene_(gpu().require(restir::Scene::create(context(), scene), "Scene")),
      table_(gpu().require(restir::LightTable::create(context(), desc), "LightTable")) {}

BuiltTable MeshTable::build() {
    gpu().submitAndWait(
        [&](VkCommandBuffer cmd) { gpu().check(table_.record(cmd, 0, &scene_), "LightTable::record"); });
    ++builds_;
    return {
        read<restir::gpu::RsPackedLight>(builds_ % 2 ? "lights 1" : "lights 0", desc_.maxLights),
        read<restir::gpu::RsAliasEntry>("light alias table", std::bit_ceil(std::max(desc_.maxLights, 2u))),
        {}};
}

}   // namespace tests
