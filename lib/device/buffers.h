// All buffers of one object, from the host's provider or from one block of memory per use.
#pragma once

#include <array>
#include <span>
#include <vector>

#include <device/device.h>

namespace restir {

class Buffers {
public:
    Buffers() = default;
    Buffers(Buffers&& other) noexcept { swap(other); }
    Buffers& operator=(Buffers&& other) noexcept {
        swap(other);
        return *this;
    }
    ~Buffers() { release(); }

    // All of them or none. `device` and the requests' names outlive the result.
    static Result<Buffers> create(const Device& device, std::span<const BufferRequest> requests) noexcept;
    // Bytes that create() allocates without a provider, and asks of one.
    static VkDeviceSize memoryNeeded(const Device& device, std::span<const BufferRequest> requests) noexcept;

    VkBuffer buffer(size_t i) const noexcept { return grants_[i].buffer; }
    template <class T>
    T* mapped(size_t i) const noexcept {
        return static_cast<T*>(grants_[i].mapped);
    }

private:
    Result<bool> allocate(std::span<const BufferRequest> requests) noexcept;
    Result<bool> allocateBlock(std::span<const BufferRequest> requests, MemoryUse use) noexcept;
    void release() noexcept;
    void swap(Buffers& other) noexcept;

    const Device* device_ = nullptr;
    std::vector<BufferGrant> grants_;
    std::array<VkDeviceMemory, 3> blocks_{};   // by MemoryUse
};

}   // namespace restir
