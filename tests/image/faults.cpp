#include "image/faults.h"

#include <cstring>
#include <map>
#include <utility>

#include <vulkan/vulkan.h>

#include <device/device.h>

namespace tests::faults {
namespace {

struct State {
    uint32_t calls = 0, lookups = 0, strangers = 0;
    uint32_t failingCall = ~0u, failingLookup = ~0u;
    VkResult result = VK_SUCCESS;
    bool namesFail = false, timestampsHidden = false;
    std::string failed;
    std::vector<std::string> names;   // of the calls
};
State state;
std::map<std::pair<std::string, uint64_t>, int> alive;   // by type and handle

bool fails(const char* call) {
    state.names.emplace_back(call);
    if (state.calls++ != state.failingCall) return false;
    state.failed = call;
    return true;
}

// Vulkan leaves undefined what a failed call returns; whoever frees this shows up.
template <class Handle>
void poison(Handle& handle) {
    const uint64_t pattern = 0xdeadbeefdeadbeefu;
    std::memcpy(&handle, &pattern, sizeof handle);
}

template <class Info, class Handle>
VkResult create(const char* call, const char* type,
                VkResult(VKAPI_PTR* real)(VkDevice, const Info*, const VkAllocationCallbacks*, Handle*),
                VkDevice device, const Info* info, const VkAllocationCallbacks* allocator, Handle* handle) {
    if (fails(call)) {
        poison(*handle);
        return state.result;
    }
    const VkResult result = real(device, info, allocator, handle);
    if (result == VK_SUCCESS) ++alive[{type, restir::handleValue(*handle)}];
    return result;
}

// False: there is no such object, and the driver must not see it.
template <class Handle>
bool dies(const char* type, Handle handle) {
    if (alive.erase({type, restir::handleValue(handle)}) == 1) return true;
    ++state.strangers;
    return false;
}

#define RESTIR_OBJECT(type, makes, Info, frees)                                                     \
    VKAPI_ATTR VkResult VKAPI_CALL makes(VkDevice d, const Info* i, const VkAllocationCallbacks* a, \
                                         Vk##type* h) {                                             \
        return create(#makes, #type, ::makes, d, i, a, h);                                          \
    }                                                                                               \
    VKAPI_ATTR void VKAPI_CALL frees(VkDevice d, Vk##type h, const VkAllocationCallbacks* a) {      \
        if (dies(#type, h)) ::frees(d, h, a);                                                       \
    }
RESTIR_OBJECT(DeviceMemory, vkAllocateMemory, VkMemoryAllocateInfo, vkFreeMemory)
RESTIR_OBJECT(Buffer, vkCreateBuffer, VkBufferCreateInfo, vkDestroyBuffer)
RESTIR_OBJECT(ShaderModule, vkCreateShaderModule, VkShaderModuleCreateInfo, vkDestroyShaderModule)
RESTIR_OBJECT(DescriptorSetLayout, vkCreateDescriptorSetLayout, VkDescriptorSetLayoutCreateInfo,
              vkDestroyDescriptorSetLayout)
RESTIR_OBJECT(PipelineLayout, vkCreatePipelineLayout, VkPipelineLayoutCreateInfo, vkDestroyPipelineLayout)
RESTIR_OBJECT(DescriptorPool, vkCreateDescriptorPool, VkDescriptorPoolCreateInfo, vkDestroyDescriptorPool)
RESTIR_OBJECT(QueryPool, vkCreateQueryPool, VkQueryPoolCreateInfo, vkDestroyQueryPool)
#undef RESTIR_OBJECT

template <class Create>
VkResult createPipelines(const char* call, uint32_t count, VkPipeline* pipelines, const Create& create) {
    if (fails(call)) {
        for (uint32_t i = 0; i < count; ++i) pipelines[i] = VK_NULL_HANDLE;   // this one is specified
        return state.result;
    }
    const VkResult result = create();
    for (uint32_t i = 0; i < count; ++i)
        if (pipelines[i]) ++alive[{"Pipeline", restir::handleValue(pipelines[i])}];
    return result;
}
VKAPI_ATTR VkResult VKAPI_CALL vkCreateComputePipelines(VkDevice device, VkPipelineCache cache,
                                                        uint32_t count,
                                                        const VkComputePipelineCreateInfo* infos,
                                                        const VkAllocationCallbacks* allocator,
                                                        VkPipeline* pipelines) {
    return createPipelines("vkCreateComputePipelines", count, pipelines, [&] {
        return ::vkCreateComputePipelines(device, cache, count, infos, allocator, pipelines);
    });
}
PFN_vkCreateRayTracingPipelinesKHR realCreateRayTracing = nullptr;
VKAPI_ATTR VkResult VKAPI_CALL vkCreateRayTracingPipelinesKHR(VkDevice device, VkDeferredOperationKHR deferred,
                                                              VkPipelineCache cache, uint32_t count,
                                                              const VkRayTracingPipelineCreateInfoKHR* infos,
                                                              const VkAllocationCallbacks* allocator,
                                                              VkPipeline* pipelines) {
    return createPipelines("vkCreateRayTracingPipelinesKHR", count, pipelines, [&] {
        return realCreateRayTracing(device, deferred, cache, count, infos, allocator, pipelines);
    });
}
PFN_vkGetRayTracingShaderGroupHandlesKHR realGetGroupHandles = nullptr;
VKAPI_ATTR VkResult VKAPI_CALL vkGetRayTracingShaderGroupHandlesKHR(VkDevice device, VkPipeline pipeline,
                                                                    uint32_t first, uint32_t count,
                                                                    size_t size, void* data) {
    return fails("vkGetRayTracingShaderGroupHandlesKHR")
               ? state.result
               : realGetGroupHandles(device, pipeline, first, count, size, data);
}
VKAPI_ATTR void VKAPI_CALL vkDestroyPipeline(VkDevice device, VkPipeline pipeline,
                                             const VkAllocationCallbacks* allocator) {
    if (dies("Pipeline", pipeline)) ::vkDestroyPipeline(device, pipeline, allocator);
}

VKAPI_ATTR VkResult VKAPI_CALL vkMapMemory(VkDevice device, VkDeviceMemory memory, VkDeviceSize offset,
                                           VkDeviceSize size, VkMemoryMapFlags flags, void** data) {
    if (fails("vkMapMemory")) {
        poison(*data);
        return state.result;
    }
    return ::vkMapMemory(device, memory, offset, size, flags, data);
}
VKAPI_ATTR VkResult VKAPI_CALL vkBindBufferMemory(VkDevice device, VkBuffer buffer, VkDeviceMemory memory,
                                                  VkDeviceSize offset) {
    return fails("vkBindBufferMemory") ? state.result : ::vkBindBufferMemory(device, buffer, memory, offset);
}
VKAPI_ATTR VkResult VKAPI_CALL vkAllocateDescriptorSets(VkDevice device,
                                                        const VkDescriptorSetAllocateInfo* info,
                                                        VkDescriptorSet* sets) {
    if (fails("vkAllocateDescriptorSets")) {
        for (uint32_t i = 0; i < info->descriptorSetCount; ++i) sets[i] = VK_NULL_HANDLE;   // specified
        return state.result;
    }
    return ::vkAllocateDescriptorSets(device, info, sets);
}
VKAPI_ATTR VkResult VKAPI_CALL vkGetQueryPoolResults(VkDevice device, VkQueryPool pool, uint32_t first,
                                                     uint32_t count, size_t size, void* data,
                                                     VkDeviceSize stride, VkQueryResultFlags flags) {
    if (fails("vkGetQueryPoolResults")) return state.result;
    return ::vkGetQueryPoolResults(device, pool, first, count, size, data, stride, flags);
}
PFN_vkSetDebugUtilsObjectNameEXT realSetName = nullptr;
VKAPI_ATTR VkResult VKAPI_CALL vkSetDebugUtilsObjectNameEXT(VkDevice device,
                                                            const VkDebugUtilsObjectNameInfoEXT* info) {
    return state.namesFail ? VK_ERROR_OUT_OF_HOST_MEMORY : realSetName(device, info);
}

VKAPI_ATTR void VKAPI_CALL getQueueFamilies(VkPhysicalDevice physical, uint32_t* count,
                                            VkQueueFamilyProperties* families) {
    ::vkGetPhysicalDeviceQueueFamilyProperties(physical, count, families);
    for (uint32_t i = 0; families && state.timestampsHidden && i < *count; ++i)
        families[i].timestampValidBits = 0;
}

bool isHidden(const char* name) {
    if (state.lookups++ != state.failingLookup) return false;
    state.failed = name;
    return true;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL getDeviceProcAddr(VkDevice device, const char* name) {
    if (isHidden(name)) return nullptr;
    const PFN_vkVoidFunction real = ::vkGetDeviceProcAddr(device, name);
#define RESTIR_OWN(function) \
    if (!std::strcmp(name, #function)) return reinterpret_cast<PFN_vkVoidFunction>(function);
    RESTIR_OWN(vkAllocateMemory)
    RESTIR_OWN(vkFreeMemory)
    RESTIR_OWN(vkMapMemory)
    RESTIR_OWN(vkCreateBuffer)
    RESTIR_OWN(vkDestroyBuffer)
    RESTIR_OWN(vkBindBufferMemory)
    RESTIR_OWN(vkCreateShaderModule)
    RESTIR_OWN(vkDestroyShaderModule)
    RESTIR_OWN(vkCreateDescriptorSetLayout)
    RESTIR_OWN(vkDestroyDescriptorSetLayout)
    RESTIR_OWN(vkCreatePipelineLayout)
    RESTIR_OWN(vkDestroyPipelineLayout)
    RESTIR_OWN(vkCreateComputePipelines)
    RESTIR_OWN(vkDestroyPipeline)
    RESTIR_OWN(vkCreateDescriptorPool)
    RESTIR_OWN(vkDestroyDescriptorPool)
    RESTIR_OWN(vkAllocateDescriptorSets)
    RESTIR_OWN(vkCreateQueryPool)
    RESTIR_OWN(vkDestroyQueryPool)
    RESTIR_OWN(vkGetQueryPoolResults)
#undef RESTIR_OWN
#define RESTIR_EXTENSION(function, address)                                 \
    if (real && !std::strcmp(name, #function)) {                            \
        address = reinterpret_cast<PFN_##function>(real);                   \
        return reinterpret_cast<PFN_vkVoidFunction>(function);              \
    }
    RESTIR_EXTENSION(vkCreateRayTracingPipelinesKHR, realCreateRayTracing)
    RESTIR_EXTENSION(vkGetRayTracingShaderGroupHandlesKHR, realGetGroupHandles)
    RESTIR_EXTENSION(vkSetDebugUtilsObjectNameEXT, realSetName)
#undef RESTIR_EXTENSION
    return real;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL getInstanceProcAddr(VkInstance instance, const char* name) {
    if (isHidden(name)) return nullptr;
    if (!std::strcmp(name, "vkGetDeviceProcAddr"))
        return reinterpret_cast<PFN_vkVoidFunction>(getDeviceProcAddr);
    if (!std::strcmp(name, "vkGetPhysicalDeviceQueueFamilyProperties"))
        return reinterpret_cast<PFN_vkVoidFunction>(getQueueFamilies);
    return ::vkGetInstanceProcAddr(instance, name);
}

}   // namespace

restir::DeviceInfo wrap(restir::DeviceInfo info) {
    info.getInstanceProcAddr = getInstanceProcAddr;
    return info;
}

void reset() { state = {}; }
void failCallAfter(uint32_t calls, VkResult result) {
    state.failingCall = state.calls + calls;
    state.result = result;
}
void hideTimestamps() { state.timestampsHidden = true; }
void failNames() { state.namesFail = true; }
void failLookupAfter(uint32_t lookups) { state.failingLookup = state.lookups + lookups; }
uint32_t calls() { return state.calls; }
std::vector<std::string> callNames() { return state.names; }
uint32_t lookups() { return state.lookups; }
const std::string& failed() { return state.failed; }
uint32_t strangers() { return state.strangers; }

std::string live() {
    std::map<std::string, int> counts;
    for (const auto& [object, count] : alive) counts[object.first] += count;
    std::string text;
    for (const auto& [type, count] : counts) text += std::to_string(count) + " " + type + " ";
    return text;
}

}   // namespace tests::faults
