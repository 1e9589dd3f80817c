#pragma once

#include <cstdint>
#include <span>

#include <vulkan/vulkan_core.h>

#include <restir/result.h>

namespace restir {

// How passes trace rays; each with the same estimators.
enum class RayBackend : uint8_t {
    RayQuery,   // VK_KHR_ray_query on FrameInput::tlas
    Pipeline,   // VK_KHR_ray_tracing_pipeline on it: passes that trace are ray generation shaders
    Software,   // a Bvh in storage buffers, on any device
    Own,        // the host's: a ShaderPack compiled with its restir_rays.glsl, on what it binds in set 1
};

// Extensions and features to turn on when the host makes its VkDevice. Merge them into the host's own chain,
// or hand chain() to vkCreateDevice as pNext.
struct DeviceNeeds {
    uint32_t apiVersion = VK_API_VERSION_1_3;
    std::span<const char* const> extensions;
    VkPhysicalDeviceFeatures core{};
    VkPhysicalDeviceVulkan12Features vulkan12{};
    VkPhysicalDeviceVulkan13Features vulkan13{};
    VkPhysicalDeviceAccelerationStructureFeaturesKHR accelerationStructure{};
    VkPhysicalDeviceRayQueryFeaturesKHR rayQuery{};
    VkPhysicalDeviceRayTracingPipelineFeaturesKHR rayTracingPipeline{};

    // Links those of the structs above that are used and returns their head. Points into this object: do not move it afterwards.
    const VkPhysicalDeviceFeatures2* chain() noexcept;

private:
    VkPhysicalDeviceFeatures2 head_{};
};
DeviceNeeds deviceNeeds(RayBackend backend) noexcept;

// ---- device memory -------------------------------------------------------------------------

enum class MemoryUse : uint8_t { DeviceOnly, HostWrite, HostRead };

struct BufferRequest {
    VkDeviceSize size = 0;   // bytes, > 0
    VkBufferUsageFlags usage = 0;
    MemoryUse use = MemoryUse::DeviceOnly;
    const char* name = "";   // static text
};

struct BufferGrant {
    VkBuffer buffer = VK_NULL_HANDLE;
    void* mapped = nullptr;   // HostWrite and HostRead: coherent, mapped for life
    void* token = nullptr;    // the host's own, handed back on release
};

// Where buffers come from; memory of those whose usage has SHADER_DEVICE_ADDRESS is allocated with device addresses. Leave empty to let each SDK object allocate one block per MemoryUse. All buffers are
// acquired in create() and released in the destructor.
struct MemoryProvider {
    void* user = nullptr;
    VkResult (*acquire)(void* user, const BufferRequest& request, BufferGrant& grant) = nullptr;
    void (*release)(void* user, const BufferGrant& grant) = nullptr;
};

// ---- host device ---------------------------------------------------------------------------

enum class Severity : uint8_t { Info, Warning, Error };

// Called on the thread that called the SDK; `text` lives for the call.
struct MessageSink {
    void* user = nullptr;
    void (*report)(void* user, Severity severity, const char* text) = nullptr;
};

// Borrowed, never destroyed. All must outlive every object made from them.
struct DeviceInfo {
    PFN_vkGetInstanceProcAddr getInstanceProcAddr = nullptr;
    VkInstance instance = VK_NULL_HANDLE;
    VkPhysicalDevice physicalDevice = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
    VkPipelineCache pipelineCache = VK_NULL_HANDLE;
    const VkAllocationCallbacks* hostAllocator = nullptr;
    MemoryProvider memory = {};
    MessageSink messages = {};
};

// Whether a physical device can do what deviceNeeds() asks; each thing it lacks is one message. Only
// `getInstanceProcAddr`, `instance`, `physicalDevice` and `messages` are read.
[[nodiscard]] Status checkDevice(const DeviceInfo& info, RayBackend backend) noexcept;

}   // namespace restir
