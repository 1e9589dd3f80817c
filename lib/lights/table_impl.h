#pragma once

#include <device/buffers.h>
#include <lights/pack.h>
#include <restir/lights.h>

namespace restir {

struct LightTable::Impl {
    const Context::Impl* context = nullptr;
    const Device* device = nullptr;
    uint64_t serial = 0;   // tells tables apart, whatever their addresses
    uint32_t framesInFlight = 0;
    uint32_t maxLights = 0;
    Buffers buffers;   // see Slot in table.cpp
    PackedLights packed;
    bool uploaded = false;        // packed has not been recorded yet
    uint32_t uploadSlot = 0;
    uint64_t generation = 0;      // of the recorded lights; 0: none yet
    uint32_t count = 0;           // columns of the alias table, this generation and the last
    uint32_t previousCount = 0;
    uint32_t textures = 0;        // one more than the largest texture index, this generation

    VkBuffer current() const noexcept;
    VkBuffer previous() const noexcept;
    VkBuffer alias() const noexcept;
};

}   // namespace restir
