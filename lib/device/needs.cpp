#include <cstring>
#include <vector>

#include <device/functions.h>
#include <device/messages.h>
#include <rays/backend.h>

namespace restir {
namespace {

constexpr const char* kRayQueryExtensions[] = {
    VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME,
    VK_KHR_DEFERRED_HOST_OPERATIONS_EXTENSION_NAME,
    VK_KHR_RAY_QUERY_EXTENSION_NAME,
};

constexpr const char* kRayPipelineExtensions[] = {
    VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME,
    VK_KHR_DEFERRED_HOST_OPERATIONS_EXTENSION_NAME,
    VK_KHR_RAY_TRACING_PIPELINE_EXTENSION_NAME,
};

struct Flag {
    const char* name;
    VkBool32 wanted;
    VkBool32 present;
};

Status reportMissing(const MessageSink& sink, std::span<const Flag> flags) noexcept {
    Status status = Status::Ok;
    for (const Flag& flag : flags) {
        if (!flag.wanted || flag.present) continue;
        report(sink, Severity::Error, "restir: the device lacks the feature %s", flag.name);
        status = Status::MissingFeature;
    }
    return status;
}

}   // namespace

const VkPhysicalDeviceFeatures2* DeviceNeeds::chain() noexcept {
    head_ = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, .pNext = &vulkan12, .features = core};
    vulkan12.pNext = &vulkan13;
    void** end = &vulkan13.pNext;
    const auto append = [&](auto& features) {
        *end = &features;
        end = &features.pNext;
    };
    if (accelerationStructure.accelerationStructure) append(accelerationStructure);
    if (rayQuery.rayQuery) append(rayQuery);
    if (rayTracingPipeline.rayTracingPipeline) append(rayTracingPipeline);
    *end = nullptr;
    return &head_;
}

DeviceNeeds deviceNeeds(RayBackend backend) noexcept {
    DeviceNeeds needs;
    needs.core.shaderStorageImageWriteWithoutFormat = VK_TRUE;
    needs.core.shaderStorageBufferArrayDynamicIndexing = VK_TRUE;
    needs.vulkan12.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES;
    needs.vulkan12.scalarBlockLayout = VK_TRUE;
    needs.vulkan12.bufferDeviceAddress = VK_TRUE;
    needs.vulkan12.descriptorIndexing = VK_TRUE;
    needs.vulkan12.runtimeDescriptorArray = VK_TRUE;
    needs.vulkan12.descriptorBindingPartiallyBound = VK_TRUE;
    needs.vulkan12.shaderSampledImageArrayNonUniformIndexing = VK_TRUE;
    needs.vulkan13.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES;
    needs.vulkan13.synchronization2 = VK_TRUE;
    needs.vulkan13.maintenance4 = VK_TRUE;
    needs.accelerationStructure.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_FEATURES_KHR;
    needs.rayQuery.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_QUERY_FEATURES_KHR;
    needs.rayTracingPipeline.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_TRACING_PIPELINE_FEATURES_KHR;
    if (!tracesStructures(backend)) return needs;
    needs.accelerationStructure.accelerationStructure = VK_TRUE;
    if (backend == RayBackend::RayQuery) {
        needs.extensions = kRayQueryExtensions;
        needs.rayQuery.rayQuery = VK_TRUE;
    } else {
        needs.extensions = kRayPipelineExtensions;
        needs.rayTracingPipeline.rayTracingPipeline = VK_TRUE;
    }
    return needs;
}

Status checkDevice(const DeviceInfo& info, RayBackend backend) noexcept {
    if (!info.getInstanceProcAddr) return refuse(info.messages, "restir: DeviceInfo::getInstanceProcAddr is null");
    if (!info.instance) return refuse(info.messages, "restir: DeviceInfo::instance is null");
    if (!info.physicalDevice) return refuse(info.messages, "restir: DeviceInfo::physicalDevice is null");
    Functions f;
    if (const char* missing = loadInstanceFunctions(info, f)) {
        report(info.messages, Severity::Error, "restir: the loader lacks %s", missing);
        return Status::MissingFeature;
    }
    VkPhysicalDeviceProperties2 properties{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2};
    f.vkGetPhysicalDeviceProperties2(info.physicalDevice, &properties);
    const DeviceNeeds want = deviceNeeds(backend);
    if (properties.properties.apiVersion < want.apiVersion) {
        report(info.messages, Severity::Error, "restir: the device speaks Vulkan %u.%u, 1.3 is needed",
               VK_API_VERSION_MAJOR(properties.properties.apiVersion),
               VK_API_VERSION_MINOR(properties.properties.apiVersion));
        return Status::MissingFeature;
    }

    uint32_t count = 0;
    f.vkEnumerateDeviceExtensionProperties(info.physicalDevice, nullptr, &count, nullptr);
    std::vector<VkExtensionProperties> extensions(count);
    f.vkEnumerateDeviceExtensionProperties(info.physicalDevice, nullptr, &count, extensions.data());
    Status status = Status::Ok;
    for (const char* name : want.extensions) {
        bool found = false;
        for (const auto& extension : extensions) found = found || !std::strcmp(extension.extensionName, name);
        if (found) continue;
        report(info.messages, Severity::Error, "restir: the device lacks the extension %s", name);
        status = Status::MissingFeature;
    }
    if (status != Status::Ok) return status;

    DeviceNeeds have = want;
    auto* features = const_cast<VkPhysicalDeviceFeatures2*>(have.chain());
    f.vkGetPhysicalDeviceFeatures2(info.physicalDevice, features);
    have.core = features->features;
    const Flag flags[] = {
#define RESTIR_FLAG(group, name) {#name, want.group.name, have.group.name}
        RESTIR_FLAG(core, shaderStorageImageWriteWithoutFormat),
        RESTIR_FLAG(core, shaderStorageBufferArrayDynamicIndexing),
        RESTIR_FLAG(vulkan12, scalarBlockLayout),
        RESTIR_FLAG(vulkan12, bufferDeviceAddress),
        RESTIR_FLAG(vulkan12, descriptorIndexing),
        RESTIR_FLAG(vulkan12, runtimeDescriptorArray),
        RESTIR_FLAG(vulkan12, descriptorBindingPartiallyBound),
        RESTIR_FLAG(vulkan12, shaderSampledImageArrayNonUniformIndexing),
        RESTIR_FLAG(vulkan13, synchronization2),
        RESTIR_FLAG(vulkan13, maintenance4),
        RESTIR_FLAG(accelerationStructure, accelerationStructure),
        RESTIR_FLAG(rayQuery, rayQuery),
        RESTIR_FLAG(rayTracingPipeline, rayTracingPipeline),
#undef RESTIR_FLAG
    };
    return reportMissing(info.messages, flags);
}

}   // namespace restir
