// Vulkan through the host's loader: one table per Context, no link to libvulkan.
#pragma once

#include <restir/device.h>

#define RESTIR_INSTANCE_FUNCTIONS(X)      \
    X(vkGetDeviceProcAddr)                \
    X(vkGetPhysicalDeviceProperties2)     \
    X(vkGetPhysicalDeviceFeatures2)       \
    X(vkGetPhysicalDeviceMemoryProperties) \
    X(vkGetPhysicalDeviceQueueFamilyProperties) \
    X(vkEnumerateDeviceExtensionProperties)

#define RESTIR_DEVICE_FUNCTIONS(X)     \
    X(vkAllocateMemory)                \
    X(vkFreeMemory)                    \
    X(vkMapMemory)                     \
    X(vkCreateBuffer)                  \
    X(vkDestroyBuffer)                 \
    X(vkBindBufferMemory)              \
    X(vkGetDeviceBufferMemoryRequirements) \
    X(vkCreateShaderModule)            \
    X(vkDestroyShaderModule)           \
    X(vkCreateDescriptorSetLayout)     \
    X(vkDestroyDescriptorSetLayout)    \
    X(vkCreatePipelineLayout)          \
    X(vkDestroyPipelineLayout)         \
    X(vkCreateComputePipelines)        \
    X(vkDestroyPipeline)               \
    X(vkCreateDescriptorPool)          \
    X(vkDestroyDescriptorPool)         \
    X(vkAllocateDescriptorSets)        \
    X(vkUpdateDescriptorSets)          \
    X(vkCreateQueryPool)               \
    X(vkDestroyQueryPool)              \
    X(vkGetQueryPoolResults)           \
    X(vkCmdResetQueryPool)             \
    X(vkCmdWriteTimestamp2)            \
    X(vkCmdPipelineBarrier2)           \
    X(vkCmdBindPipeline)               \
    X(vkCmdBindDescriptorSets)         \
    X(vkCmdPushConstants)              \
    X(vkCmdDispatch)                   \
    X(vkCmdCopyBuffer)                 \
    X(vkCmdFillBuffer)

// Asked for with RayBackend::Pipeline only.
#define RESTIR_RAY_PIPELINE_FUNCTIONS(X)    \
    X(vkCreateRayTracingPipelinesKHR)       \
    X(vkGetRayTracingShaderGroupHandlesKHR) \
    X(vkGetBufferDeviceAddress)             \
    X(vkCmdTraceRaysKHR)

// Absent where the host made its instance without VK_EXT_debug_utils.
#define RESTIR_OPTIONAL_FUNCTIONS(X)   \
    X(vkSetDebugUtilsObjectNameEXT)    \
    X(vkCmdBeginDebugUtilsLabelEXT)    \
    X(vkCmdEndDebugUtilsLabelEXT)

namespace restir {

struct Functions {
#define RESTIR_DECLARE(name) PFN_##name name = nullptr;
    RESTIR_INSTANCE_FUNCTIONS(RESTIR_DECLARE)
    RESTIR_DEVICE_FUNCTIONS(RESTIR_DECLARE)
    RESTIR_RAY_PIPELINE_FUNCTIONS(RESTIR_DECLARE)
    RESTIR_OPTIONAL_FUNCTIONS(RESTIR_DECLARE)
#undef RESTIR_DECLARE
};

// Name of the first function that is missing, null if all are there.
const char* loadInstanceFunctions(const DeviceInfo& info, Functions& functions) noexcept;
const char* loadDeviceFunctions(const DeviceInfo& info, RayBackend rays, Functions& functions) noexcept;

}   // namespace restir
