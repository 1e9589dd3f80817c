// What every object needs of the host's device.
#pragma once

#include <device/functions.h>
#include <device/messages.h>

namespace restir {

struct Device {
    DeviceInfo info;
    Functions functions;
    VkPhysicalDeviceMemoryProperties memory{};
    VkPhysicalDeviceLimits limits{};
    VkPipelineStageFlags2 passStages = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;   // where the Context's passes run
    uint32_t timestampBits = 0;   // of the queue family; 0: no timestamps

    const VkAllocationCallbacks* allocator() const noexcept { return info.hostAllocator; }
    const MessageSink& sink() const noexcept { return info.messages; }
    void name(VkObjectType type, uint64_t handle, const char* text) const noexcept;
};

// Vulkan handles are pointers or integers, depending on the platform.
template <class Handle>
uint64_t handleValue(Handle handle) noexcept {
    if constexpr (std::is_pointer_v<Handle>) return uint64_t(reinterpret_cast<uintptr_t>(handle));
    else return handle;
}

// Vulkan leaves undefined what a call that failed returns; null is what destructors know.
template <class Handle>
VkResult orNull(VkResult vk, Handle& handle) noexcept {
    if (vk != VK_SUCCESS) handle = VK_NULL_HANDLE;
    return vk;
}

}   // namespace restir
