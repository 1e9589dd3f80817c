#include "fuzz/null_device.h"

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <type_traits>

#include <device/functions.h>

namespace fuzz {
namespace {

constexpr VkDeviceSize kMostBytes = VkDeviceSize{1} << 28;   // of a buffer
constexpr uint32_t kMostGroups = 65535;

// What a VkBuffer points to.
struct Buffer {
    VkDeviceSize size;
    void* mapped;
};

void insist(bool condition, const char* what) {
    if (condition) return;
    std::fprintf(stderr, "null device: %s\n", what);
    std::abort();
}

bool inside(VkBuffer buffer, VkDeviceSize offset, VkDeviceSize size) {
    const VkDeviceSize all = reinterpret_cast<const Buffer*>(buffer)->size;
    return offset <= all && size <= all - offset;
}

VkResult acquire(void*, const restir::BufferRequest& request, restir::BufferGrant& grant) {
    insist(request.size > 0, "a buffer without size");
    if (request.size > kMostBytes) return VK_ERROR_OUT_OF_DEVICE_MEMORY;
    auto* buffer = new Buffer{request.size, nullptr};
    if (request.use != restir::MemoryUse::DeviceOnly) buffer->mapped = std::calloc(request.size, 1);
    grant = {.buffer = reinterpret_cast<VkBuffer>(buffer), .mapped = buffer->mapped, .token = buffer};
    return VK_SUCCESS;
}

void release(void*, const restir::BufferGrant& grant) {
    const auto* buffer = static_cast<Buffer*>(grant.token);
    std::free(buffer->mapped);
    delete buffer;
}

// Calls that nothing is known of: what they make is some handle, and all went well.
template <class T>
void make(T* made) {
    if constexpr (std::is_pointer_v<T> && !std::is_const_v<T>) *made = someHandle<T>();
}
template <class T>
void make(const T&) {}

template <class F>
struct Any;
template <class R, class... Arguments>
struct Any<R(VKAPI_PTR*)(Arguments...)> {
    static R VKAPI_CALL call(Arguments... arguments) {
        (make(arguments), ...);
        if constexpr (!std::is_void_v<R>) return R{};
    }
};

void VKAPI_CALL properties(VkPhysicalDevice, VkPhysicalDeviceProperties2* out) {
    VkPhysicalDeviceLimits& limits = out->properties.limits;
    limits.maxStorageBufferRange = 1u << 27;
    limits.maxPerStageDescriptorSampledImages = limits.maxPerStageDescriptorSamplers = 1u << 16;
    limits.maxPerStageDescriptorStorageBuffers = limits.maxPerStageDescriptorStorageImages = 64;
    limits.timestampPeriod = 1;
}

void VKAPI_CALL queueFamilies(VkPhysicalDevice, uint32_t* count, VkQueueFamilyProperties* families) {
    *count = 1;
    if (families)
        families[0] = {.queueFlags = VK_QUEUE_COMPUTE_BIT, .queueCount = 1, .timestampValidBits = 64};
}

VkResult VKAPI_CALL allocateSets(VkDevice, const VkDescriptorSetAllocateInfo* info, VkDescriptorSet* sets) {
    for (uint32_t i = 0; i < info->descriptorSetCount; ++i) make(sets + i);
    return VK_SUCCESS;
}

void VKAPI_CALL updateSets(VkDevice, uint32_t count, const VkWriteDescriptorSet* writes, uint32_t,
                           const VkCopyDescriptorSet*) {
    for (uint32_t i = 0; i < count; ++i)
        for (uint32_t d = 0; writes[i].pBufferInfo && d < writes[i].descriptorCount; ++d) {
            const VkDescriptorBufferInfo& info = writes[i].pBufferInfo[d];
            if (info.buffer == someHandle<VkBuffer>()) continue;   // the host's
            const VkDeviceSize size = info.range == VK_WHOLE_SIZE ? 0 : info.range;
            insist(inside(info.buffer, info.offset, size), "a descriptor reaches past its buffer");
        }
}

void VKAPI_CALL copy(VkCommandBuffer, VkBuffer from, VkBuffer to, uint32_t count,
                     const VkBufferCopy* regions) {
    for (uint32_t i = 0; i < count; ++i) {
        const VkBufferCopy& r = regions[i];
        insist(r.size > 0 && inside(from, r.srcOffset, r.size) && inside(to, r.dstOffset, r.size),
               "a copy leaves its buffers");
    }
}

void VKAPI_CALL fill(VkCommandBuffer, VkBuffer buffer, VkDeviceSize offset, VkDeviceSize size, uint32_t) {
    insist(size > 0 && inside(buffer, offset, size == VK_WHOLE_SIZE ? 0 : size), "a fill leaves its buffer");
}

void VKAPI_CALL dispatch(VkCommandBuffer, uint32_t x, uint32_t y, uint32_t z) {
    insist(x <= kMostGroups && y <= kMostGroups && z <= kMostGroups, "more groups than Vulkan guarantees");
}

PFN_vkVoidFunction VKAPI_CALL deviceFunction(VkDevice, const char* name);

template <class F>
PFN_vkVoidFunction erased(F function) {
    return reinterpret_cast<PFN_vkVoidFunction>(function);
}

PFN_vkVoidFunction find(const char* name) {
    const auto is = [&](const char* known) { return std::strcmp(name, known) == 0; };
    if (is("vkGetDeviceProcAddr")) return erased(PFN_vkGetDeviceProcAddr(deviceFunction));
    if (is("vkGetPhysicalDeviceProperties2")) return erased(PFN_vkGetPhysicalDeviceProperties2(properties));
    if (is("vkGetPhysicalDeviceQueueFamilyProperties"))
        return erased(PFN_vkGetPhysicalDeviceQueueFamilyProperties(queueFamilies));
    if (is("vkAllocateDescriptorSets")) return erased(PFN_vkAllocateDescriptorSets(allocateSets));
    if (is("vkUpdateDescriptorSets")) return erased(PFN_vkUpdateDescriptorSets(updateSets));
    if (is("vkCmdCopyBuffer")) return erased(PFN_vkCmdCopyBuffer(copy));
    if (is("vkCmdFillBuffer")) return erased(PFN_vkCmdFillBuffer(fill));
    if (is("vkCmdDispatch")) return erased(PFN_vkCmdDispatch(dispatch));
#define FUZZ_ANY(function) \
    if (is(#function)) return erased(&Any<PFN_##function>::call);
    RESTIR_INSTANCE_FUNCTIONS(FUZZ_ANY)
    RESTIR_DEVICE_FUNCTIONS(FUZZ_ANY)
    RESTIR_OPTIONAL_FUNCTIONS(FUZZ_ANY)
#undef FUZZ_ANY
    return nullptr;
}

PFN_vkVoidFunction VKAPI_CALL deviceFunction(VkDevice, const char* name) { return find(name); }
PFN_vkVoidFunction VKAPI_CALL instanceFunction(VkInstance, const char* name) { return find(name); }

// Reads what it is told, as a host's log would.
void listen(void*, restir::Severity, const char* text) {
    insist(std::strlen(text) > 8, "a message without words");
}

}   // namespace

restir::DeviceInfo nullDevice() {
    return {.getInstanceProcAddr = instanceFunction,
            .instance = someHandle<VkInstance>(),
            .physicalDevice = someHandle<VkPhysicalDevice>(),
            .device = someHandle<VkDevice>(),
            .memory = {.acquire = acquire, .release = release},
            .messages = {.report = listen}};
}

}   // namespace fuzz
