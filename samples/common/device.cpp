#include "common/device.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <vector>

namespace samples {
namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";
constexpr std::array kStructureExtensions = {VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME,
                                             VK_KHR_DEFERRED_HOST_OPERATIONS_EXTENSION_NAME};

bool hasLayer(const char* name) {
    uint32_t count = 0;
    check(vkEnumerateInstanceLayerProperties(&count, nullptr), "vkEnumerateInstanceLayerProperties");
    std::vector<VkLayerProperties> layers(count);
    check(vkEnumerateInstanceLayerProperties(&count, layers.data()), "vkEnumerateInstanceLayerProperties");
    return std::any_of(layers.begin(), layers.end(), [&](const VkLayerProperties& layer) {
        return std::strcmp(layer.layerName, name) == 0;
    });
}

bool hasInstanceExtension(const char* name) {
    uint32_t count = 0;
    vkEnumerateInstanceExtensionProperties(nullptr, &count, nullptr);
    std::vector<VkExtensionProperties> all(count);
    vkEnumerateInstanceExtensionProperties(nullptr, &count, all.data());
    return std::any_of(all.begin(), all.end(), [&](const VkExtensionProperties& extension) {
        return std::strcmp(extension.extensionName, name) == 0;
    });
}

bool hasExtension(VkPhysicalDevice physical, const char* name) {
    uint32_t count = 0;
    vkEnumerateDeviceExtensionProperties(physical, nullptr, &count, nullptr);
    std::vector<VkExtensionProperties> all(count);
    vkEnumerateDeviceExtensionProperties(physical, nullptr, &count, all.data());
    return std::any_of(all.begin(), all.end(), [&](const VkExtensionProperties& extension) {
        return std::strcmp(extension.extensionName, name) == 0;
    });
}

bool hasStructures(VkPhysicalDevice physical) {
    return std::all_of(kStructureExtensions.begin(), kStructureExtensions.end(),
                       [&](const char* name) { return hasExtension(physical, name); });
}

// Real GPUs before software ones, ray query or not.
int rank(VkPhysicalDevice physical) {
    VkPhysicalDeviceProperties properties;
    vkGetPhysicalDeviceProperties(physical, &properties);
    switch (properties.deviceType) {
        case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
            return 4;
        case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
            return 3;
        case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
            return 2;
        default:
            return 1;
    }
}

// What the samples' own shaders use on top of the SDK's needs.
void addOwnFeatures(restir::DeviceNeeds& needs) {
    needs.core.shaderStorageImageWriteWithoutFormat = VK_TRUE;
    needs.core.shaderStorageImageExtendedFormats = VK_TRUE;
    needs.vulkan12.bufferDeviceAddress = VK_TRUE;
    needs.vulkan12.scalarBlockLayout = VK_TRUE;
    needs.vulkan12.descriptorBindingPartiallyBound = VK_TRUE;
    needs.vulkan12.runtimeDescriptorArray = VK_TRUE;
    needs.vulkan12.shaderSampledImageArrayNonUniformIndexing = VK_TRUE;
    needs.vulkan13.synchronization2 = VK_TRUE;
}

template <class Function>
void load(VkDevice device, const char* name, Function& function) {
    function = reinterpret_cast<Function>(vkGetDeviceProcAddr(device, name));
    if (function == nullptr) throw std::runtime_error(std::string("the driver lacks ") + name);
}

void printSdkMessage(void* user, restir::Severity severity, const char* text) {
    if (severity == restir::Severity::Error) {
        *static_cast<std::string*>(user) = text;
    } else if (severity == restir::Severity::Warning) {
        std::fprintf(stderr, "%s\n", text);
    }
}

}   // namespace

void check(VkResult result, const char* what) {
    if (result != VK_SUCCESS) {
        throw std::runtime_error(std::string(what) + " failed: VkResult " + std::to_string(result));
    }
}

VKAPI_ATTR VkBool32 VKAPI_CALL Device::report(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                              VkDebugUtilsMessageTypeFlagsEXT,
                                              const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
    ++static_cast<Device*>(user)->validationMessages_;
    std::fprintf(stderr, "validation: %s\n", data->pMessage);
    return VK_FALSE;
}

Device::Device(const DeviceDesc& desc) : hasRays_(desc.rays), hasRayQuery_(desc.rays && desc.rayQuery) {
    try {
        makeInstance(desc);
        if (desc.makeSurface) surface_ = desc.makeSurface(instance_);
        pickPhysical();
        makeDevice();
        if (hasRays_) loadRayFunctions();
    } catch (...) {
        release();
        throw;
    }
}

Device::~Device() { release(); }

void Device::release() {
    if (device_ != VK_NULL_HANDLE) {
        vkDeviceWaitIdle(device_);
        vkDestroyCommandPool(device_, pool_, nullptr);
        vkDestroyDevice(device_, nullptr);
    }
    if (surface_ != VK_NULL_HANDLE) vkDestroySurfaceKHR(instance_, surface_, nullptr);
    if (messenger_ != VK_NULL_HANDLE) {
        auto destroy = reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
            vkGetInstanceProcAddr(instance_, "vkDestroyDebugUtilsMessengerEXT"));
        destroy(instance_, messenger_, nullptr);
    }
    if (instance_ != VK_NULL_HANDLE) vkDestroyInstance(instance_, nullptr);
}

void Device::makeInstance(const DeviceDesc& desc) {
    const bool validate = desc.validate;
    if (validate && !hasLayer(kValidationLayer)) {
        throw std::runtime_error(
            "validation was asked for, but VK_LAYER_KHRONOS_validation is not installed");
    }
    const VkDebugUtilsMessengerCreateInfoEXT messengerInfo{
        .sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT,
        .messageSeverity =
            VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT,
        .messageType =
            VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT,
        .pfnUserCallback = report,
        .pUserData = this};
    const VkValidationFeatureEnableEXT enabled = VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
    const VkValidationFeaturesEXT features{.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT,
                                           .pNext = &messengerInfo,
                                           .enabledValidationFeatureCount = 1,
                                           .pEnabledValidationFeatures = &enabled};
    std::vector<const char*> extensions =
        desc.instanceExtensions;   // labels and names work without the layer, too
    if (hasInstanceExtension(VK_EXT_DEBUG_UTILS_EXTENSION_NAME) || validate) {
        extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    }
    const VkApplicationInfo application{.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO,
                                        .pApplicationName = "restir samples",
                                        .apiVersion = VK_API_VERSION_1_3};
    const VkInstanceCreateInfo info{.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
                                    .pNext = validate ? &features : nullptr,
                                    .pApplicationInfo = &application,
                                    .enabledLayerCount = validate ? 1u : 0u,
                                    .ppEnabledLayerNames = &kValidationLayer,
                                    .enabledExtensionCount = static_cast<uint32_t>(extensions.size()),
                                    .ppEnabledExtensionNames = extensions.data()};
    samples::check(vkCreateInstance(&info, nullptr, &instance_), "vkCreateInstance");
    if (!validate) return;
    auto create = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
        vkGetInstanceProcAddr(instance_, "vkCreateDebugUtilsMessengerEXT"));
    samples::check(create(instance_, &messengerInfo, nullptr, &messenger_), "vkCreateDebugUtilsMessengerEXT");
}

bool Device::isFit(VkPhysicalDevice physical) const {
    VkPhysicalDeviceProperties properties;
    vkGetPhysicalDeviceProperties(physical, &properties);
    if (properties.apiVersion < VK_API_VERSION_1_3) return false;
    if (!hasRays_) return true;
    return hasStructures(physical) && ((hasRayQuery_ && hasExtension(physical, VK_KHR_RAY_QUERY_EXTENSION_NAME)) ||
                                       hasExtension(physical, VK_KHR_RAY_TRACING_PIPELINE_EXTENSION_NAME));
}

void Device::pickPhysical() {
    uint32_t count = 0;
    samples::check(vkEnumeratePhysicalDevices(instance_, &count, nullptr), "vkEnumeratePhysicalDevices");
    std::vector<VkPhysicalDevice> all(count);
    samples::check(vkEnumeratePhysicalDevices(instance_, &count, all.data()), "vkEnumeratePhysicalDevices");
    uint32_t tracing = 0;
    for (VkPhysicalDevice candidate : all) {
        if (!isFit(candidate)) continue;
        ++tracing;
        if (!findQueueFamily(candidate)) continue;
        if (physical_ == VK_NULL_HANDLE || rank(candidate) > rank(physical_)) physical_ = candidate;
    }
    if (physical_ == VK_NULL_HANDLE && tracing > 0)
        throw std::runtime_error(surface_ ? "no device that traces rays can draw to this display"
                                          : "the device has no compute queue");
    if (physical_ == VK_NULL_HANDLE) {
        throw std::runtime_error("no Vulkan 1.3 device with ray query or ray tracing pipelines, which the samples' G-buffer and "
                                 "reference need (" +
                                 std::to_string(count) + " devices without)");
    }
    hasRayQuery_ = hasRayQuery_ && hasExtension(physical_, VK_KHR_RAY_QUERY_EXTENSION_NAME);
    hasRayPipelines_ = hasRays_ && hasExtension(physical_, VK_KHR_RAY_TRACING_PIPELINE_EXTENSION_NAME);
    VkPhysicalDeviceAccelerationStructurePropertiesKHR structures{
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_PROPERTIES_KHR};
    VkPhysicalDeviceDriverProperties driver{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES,
                                            .pNext = &structures};
    VkPhysicalDeviceProperties2 properties{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2,
                                           .pNext = &driver};
    vkGetPhysicalDeviceProperties2(physical_, &properties);
    properties_ = properties.properties;
    driver_ = std::string(driver.driverName) + " " + driver.driverInfo;
    scratchAlignment_ = structures.minAccelerationStructureScratchOffsetAlignment;
}

std::optional<uint32_t> Device::findQueueFamily(VkPhysicalDevice physical) const {
    if (surface_ && !hasExtension(physical, VK_KHR_SWAPCHAIN_EXTENSION_NAME)) return std::nullopt;
    uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families.data());
    const VkQueueFlags wanted =
        surface_ ? VK_QUEUE_COMPUTE_BIT | VK_QUEUE_GRAPHICS_BIT : VK_QUEUE_COMPUTE_BIT;
    for (uint32_t i = 0; i < count; ++i) {
        VkBool32 presents = VK_TRUE;
        if (surface_) vkGetPhysicalDeviceSurfaceSupportKHR(physical, i, surface_, &presents);
        if ((families[i].queueFlags & wanted) == wanted && presents) return i;
    }
    return std::nullopt;
}

bool Device::has(restir::RayBackend rays) const {
    return rays == restir::RayBackend::RayQuery ? hasRayQuery_ : rays != restir::RayBackend::Pipeline || hasRayPipelines_;
}

restir::RayBackend Device::bestRays() const {
    return hasRayQuery_       ? restir::RayBackend::RayQuery
           : hasRayPipelines_ ? restir::RayBackend::Pipeline
                              : restir::RayBackend::Software;
}

void Device::makeDevice() {
    queueFamily_ = findQueueFamily(physical_).value();
    uint32_t count = queueFamily_ + 1;
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(physical_, &count, families.data());
    timestampBits_ = families[queueFamily_].timestampValidBits;

    restir::DeviceNeeds needs = restir::deviceNeeds(bestRays());
    addOwnFeatures(needs);
    std::vector<const char*> extensions(needs.extensions.begin(), needs.extensions.end());
    if (hasRayQuery_ && hasRayPipelines_) {
        needs.rayTracingPipeline.rayTracingPipeline = VK_TRUE;
        extensions.push_back(VK_KHR_RAY_TRACING_PIPELINE_EXTENSION_NAME);
    }
    if (surface_) extensions.push_back(VK_KHR_SWAPCHAIN_EXTENSION_NAME);
    const float priority = 1;
    const VkDeviceQueueCreateInfo queueInfo{.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                                            .queueFamilyIndex = queueFamily_,
                                            .queueCount = 1,
                                            .pQueuePriorities = &priority};
    const VkDeviceCreateInfo info{.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                                  .pNext = needs.chain(),
                                  .queueCreateInfoCount = 1,
                                  .pQueueCreateInfos = &queueInfo,
                                  .enabledExtensionCount = static_cast<uint32_t>(extensions.size()),
                                  .ppEnabledExtensionNames = extensions.data()};
    samples::check(vkCreateDevice(physical_, &info, nullptr, &device_), "vkCreateDevice");
    vkGetDeviceQueue(device_, queueFamily_, 0, &queue_);
    const VkCommandPoolCreateInfo poolInfo{.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                           .flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT,
                                           .queueFamilyIndex = queueFamily_};
    samples::check(vkCreateCommandPool(device_, &poolInfo, nullptr, &pool_), "vkCreateCommandPool");
}

void Device::loadRayFunctions() {
    load(device_, "vkCreateAccelerationStructureKHR", rays_.createAccelerationStructure);
    load(device_, "vkDestroyAccelerationStructureKHR", rays_.destroyAccelerationStructure);
    load(device_, "vkGetAccelerationStructureBuildSizesKHR", rays_.buildSizes);
    load(device_, "vkGetAccelerationStructureDeviceAddressKHR", rays_.deviceAddress);
    load(device_, "vkCmdBuildAccelerationStructuresKHR", rays_.cmdBuild);
}

restir::DeviceInfo Device::sdkInfo() {
    restir::DeviceInfo info;
    info.getInstanceProcAddr = vkGetInstanceProcAddr;
    info.instance = instance_;
    info.physicalDevice = physical_;
    info.device = device_;
    info.messages = {.user = &sdkError_, .report = printSdkMessage};
    return info;
}

void Device::fail(const restir::Error& error, const char* what) const {
    throw std::runtime_error(sdkError_.empty() ? std::string(what) + ": " + error.what : sdkError_);
}

void Device::check(restir::Status status, const char* what) const {
    if (status != restir::Status::Ok) fail({.status = status, .what = "refused without a message"}, what);
}

void Device::submitAndWait(const std::function<void(VkCommandBuffer)>& record) const {
    const VkCommandBufferAllocateInfo allocation{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                                 .commandPool = pool_,
                                                 .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
                                                 .commandBufferCount = 1};
    VkCommandBuffer commands = VK_NULL_HANDLE;
    samples::check(vkAllocateCommandBuffers(device_, &allocation, &commands), "vkAllocateCommandBuffers");
    const VkCommandBufferBeginInfo begin{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                         .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT};
    samples::check(vkBeginCommandBuffer(commands, &begin), "vkBeginCommandBuffer");
    record(commands);
    samples::check(vkEndCommandBuffer(commands), "vkEndCommandBuffer");
    const VkSubmitInfo submit{
        .sType = VK_STRUCTURE_TYPE_SUBMIT_INFO, .commandBufferCount = 1, .pCommandBuffers = &commands};
    samples::check(vkQueueSubmit(queue_, 1, &submit, VK_NULL_HANDLE), "vkQueueSubmit");
    samples::check(vkQueueWaitIdle(queue_), "vkQueueWaitIdle");
    vkFreeCommandBuffers(device_, pool_, 1, &commands);
}

}   // namespace samples
