#pragma once

#include <device/buffers.h>
#include <device/stopwatch.h>
#include <frame/context_impl.h>
#include <lights/environment.h>
#include <lights/pack.h>
#include <restir/lights.h>

namespace restir {

// Buffers of a LightTable, in this order; a staging buffer for each frame slot follows.
enum class TableBuffer : size_t {
    Lights0,   // two generations
    Lights1,
    Alias,   // of the newer one
    State,   // of its build, as all that follow
    Excess,
    Deficit,
    Blocks,
    FirstSlot,
};

struct LightTable::Impl {
    explicit Impl(const LightLimits& limits) : packer(limits) {}
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
    PackedLights uploaded;        // in the staging buffer of uploadSlot
    bool pending = false;         // which has not been recorded yet
    uint32_t uploadSlot = 0;
    PackedLights recorded;
    uint64_t generation = 0;      // of the recorded lights; 0: none yet
    uint32_t previousCount = 0;   // PackedLights::count of the generation before

    VkBuffer buffer(TableBuffer b) const noexcept { return buffers.buffer(size_t(b)); }
    size_t stagingOf(uint32_t slot) const noexcept { return size_t(TableBuffer::FirstSlot) + slot; }
    VkBuffer current() const noexcept { return buffer(generation % 2 ? TableBuffer::Lights1 : TableBuffer::Lights0); }
    VkBuffer previous() const noexcept { return buffer(generation % 2 ? TableBuffer::Lights0 : TableBuffer::Lights1); }
    VkBuffer alias() const noexcept { return buffer(TableBuffer::Alias); }
};

}   // namespace restir
