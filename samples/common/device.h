// Everything a small host needs around the SDK: an instance, a device that traces rays, one queue.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <vulkan/vulkan.h>

#include <restir/device.h>

namespace samples {

// Throws std::runtime_error naming `what` and the result unless `result` is VK_SUCCESS.
void check(VkResult result, const char* what);

struct DeviceDesc {
    bool rays = true;        // off: as if no device had acceleration structures or ray query
    bool rayQuery = true;    // off: as if no device had ray query; ray tracing pipelines will do
    bool validate = false;   // core and synchronization validation; messages are printed and counted
    // For a window: extensions of the instance, and what makes its surface, which the Device then owns and
    // can present to.
    std::vector<const char*> instanceExtensions = {};
    std::function<VkSurfaceKHR(VkInstance)> makeSurface = {};
};

// Functions of extensions, which the loader does not export.
struct RayFunctions {
    PFN_vkCreateAccelerationStructureKHR createAccelerationStructure = nullptr;
    PFN_vkDestroyAccelerationStructureKHR destroyAccelerationStructure = nullptr;
    PFN_vkGetAccelerationStructureBuildSizesKHR buildSizes = nullptr;
    PFN_vkGetAccelerationStructureDeviceAddressKHR deviceAddress = nullptr;
    PFN_vkCmdBuildAccelerationStructuresKHR cmdBuild = nullptr;
};

// Not movable: the SDK's message sink points here. Makers throw std::runtime_error.
class Device {
public:
    explicit Device(const DeviceDesc& desc = {});
    ~Device();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    VkInstance instance() const { return instance_; }
    VkPhysicalDevice physical() const { return physical_; }
    VkDevice handle() const { return device_; }
    VkQueue queue() const { return queue_; }
    uint32_t queueFamily() const { return queueFamily_; }
    VkSurfaceKHR surface() const { return surface_; }   // null without a window; the queue can draw then, too
    const RayFunctions& rays() const { return rays_; }
    const VkPhysicalDeviceProperties& properties() const { return properties_; }
    const std::string& driver() const { return driver_; }
    uint32_t scratchAlignment() const { return scratchAlignment_; }   // of acceleration structure builds
    bool hasRayQuery() const { return hasRayQuery_; }           // what RayBackend::RayQuery needs
    bool hasRayPipelines() const { return hasRayPipelines_; }   // what RayBackend::Pipeline needs
    bool has(restir::RayBackend rays) const;
    restir::RayBackend bestRays() const;   // of the SDK's
    bool hasTimestamps() const { return timestampBits_ != 0; }

    // What the SDK is given. Its warnings go to stderr, its last error to sdkError().
    restir::DeviceInfo sdkInfo();
    const std::string& sdkError() const { return sdkError_; }
    // Throws what the SDK said unless `status` is Ok.
    void check(restir::Status status, const char* what) const;
    // The value, or throws what the SDK said.
    template <class T>
    T require(restir::Result<T> result, const char* what) const {
        if (!result) fail(result.error(), what);
        return std::move(*result);
    }

    uint32_t validationMessages() const { return validationMessages_; }   // warnings and errors so far

    // Records a command buffer, submits it and waits for the GPU to finish.
    void submitAndWait(const std::function<void(VkCommandBuffer)>& record) const;
    void waitIdle() const { vkDeviceWaitIdle(device_); }

private:
    void makeInstance(const DeviceDesc& desc);
    void pickPhysical();
    std::optional<uint32_t> findQueueFamily(VkPhysicalDevice physical) const;
    void makeDevice();
    void loadRayFunctions();
    bool isFit(VkPhysicalDevice physical) const;
    void release();
    [[noreturn]] void fail(const restir::Error& error, const char* what) const;
    static VKAPI_ATTR VkBool32 VKAPI_CALL report(VkDebugUtilsMessageSeverityFlagBitsEXT severity,
                                                 VkDebugUtilsMessageTypeFlagsEXT types,
                                                 const VkDebugUtilsMessengerCallbackDataEXT* data,
                                                 void* user);

    VkInstance instance_ = VK_NULL_HANDLE;
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
    VkSurfaceKHR surface_ = VK_NULL_HANDLE;
    VkPhysicalDevice physical_ = VK_NULL_HANDLE;
    VkDevice device_ = VK_NULL_HANDLE;
    VkQueue queue_ = VK_NULL_HANDLE;
    VkCommandPool pool_ = VK_NULL_HANDLE;
    uint32_t queueFamily_ = 0;
    uint32_t timestampBits_ = 0;
    bool hasRays_ = true, hasRayQuery_ = true, hasRayPipelines_ = false;
    uint32_t scratchAlignment_ = 1;
    VkPhysicalDeviceProperties properties_{};
    std::string driver_;
    RayFunctions rays_;
    std::string sdkError_;
    std::atomic<uint32_t> validationMessages_ = 0;
};

// What a submission waits for, and what it signals: for pictures of a window.
struct WindowSync {
    VkSemaphore acquired = VK_NULL_HANDLE;
    VkPipelineStageFlags waitingStages = 0;   // that touch the window's picture first
    VkSemaphore rendered = VK_NULL_HANDLE;
};

// Command buffers for frames in flight: begin() waits until the GPU is done with the slot's last use.
class FrameSlots {
public:
    static constexpr uint32_t kCount = 2;

    explicit FrameSlots(const Device& device);
    ~FrameSlots();
    FrameSlots(const FrameSlots&) = delete;
    FrameSlots& operator=(const FrameSlots&) = delete;

    void wait(uint32_t slot) const;
    VkCommandBuffer begin(uint32_t slot);
    void submit(uint32_t slot, const WindowSync* window = nullptr);

private:
    const Device& device_;
    VkCommandPool pool_ = VK_NULL_HANDLE;
    VkCommandBuffer commands_[kCount] = {};
    VkFence fences_[kCount] = {};
};

}   // namespace samples
