#pragma once

#include <device/buffers.h>
#include <device/stopwatch.h>
#include <frame/context_impl.h>
#include <lights/environment.h>
#include <lights/meshes.h>
#include <lights/pack.h>
#include <restir/lights.h>

namespace restir {

// Buffers of a LightTable, in this order; a staging buffer for each frame slot follows, lights before meshes.
enum class TableBuffer : size_t {
    Lights0,   // two generations
    Lights1,
    Alias,   // of the newer one
    State,   // of its build, as all that follow
    Excess,
    Deficit,
    Blocks,
    Kept,     // the last uploaded lights, where meshes bring a build without an upload
    Meshes,   // RsLightMesh[]
    Means,    // of textures, by light of a mesh
    Tree,     // with LightTableDesc::tree
    Counts,   // of its sort
    FirstSlot,
};

struct LightTable::Impl {
    Impl(const LightTableDesc& desc, const LightLimits& limits)
        : packer(limits), meshPacker(desc.maxMeshes, desc.meshLights), meshLights(desc.meshLights), hasTree(desc.tree) {}
    ~Impl();

    const Context::Impl* context = nullptr;
    const Device* device = nullptr;
    uint64_t serial = 0;   // tells tables apart, whatever their addresses
    Buffers buffers;
    VkDescriptorPool pool = VK_NULL_HANDLE;
    VkDescriptorSet sets[2] = {};   // by parity of the generation
    Stopwatch stopwatch;
    EnvironmentTable environment;
    LightPacker packer;
    MeshPacker meshPacker;
    uint32_t meshLights = 0;      // LightTableDesc's
    bool hasTree = false;
    VkDeviceSize meshOffset = 0;  // in staging buffers
    PackedLights uploaded;        // in the staging buffer of lightSlot
    PackedMeshes meshes;          // likewise of meshSlot
    bool pendingLights = false, pendingMeshes = false;   // which have not been recorded yet
    uint32_t lightSlot = 0, meshSlot = 0;
    PackedLights recorded;        // `count` with meshes
    uint64_t generation = 0;      // of the recorded lights; 0: none yet
    uint32_t previousCount = 0;   // PackedLights::count of the generation before

    bool pending() const noexcept { return pendingLights || pendingMeshes; }
    VkBuffer buffer(TableBuffer b) const noexcept { return buffers.buffer(size_t(b)); }
    size_t stagingOf(uint32_t slot) const noexcept { return size_t(TableBuffer::FirstSlot) + slot; }
    VkBuffer current() const noexcept { return buffer(generation % 2 ? TableBuffer::Lights1 : TableBuffer::Lights0); }
    VkBuffer previous() const noexcept { return buffer(generation % 2 ? TableBuffer::Lights0 : TableBuffer::Lights1); }
    VkDeviceSize uploadBytes() const noexcept {   // of the uploaded lights
        return uploaded.count > meshLights ? (uploaded.count - meshLights) * sizeof(gpu::RsPackedLight) : 0;
    }
    VkBuffer alias() const noexcept { return buffer(TableBuffer::Alias); }
};

}   // namespace restir
