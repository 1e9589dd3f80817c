// Acceleration structures: one bottom level for each mesh, top levels of instances.
#pragma once

#include <vector>

#include "common/gpu_memory.h"

namespace samples {

struct TriangleRange {
    VkDeviceAddress positions = 0, indices = 0;
    uint32_t vertexCount = 0, triangleCount = 0;
    bool opaque = true;
};

// One top level, built on the GPU from a list of VkAccelerationStructureInstanceKHR.
class TopLevel {
public:
    TopLevel() = default;
    TopLevel(const Device& device, uint32_t instances);
    ~TopLevel();
    TopLevel(TopLevel&& other) noexcept { swap(other); }
    TopLevel& operator=(TopLevel&& other) noexcept {
        swap(other);
        return *this;
    }

    VkAccelerationStructureKHR handle() const { return handle_; }
    VkDeviceSize bytes() const { return storage_.size(); }
    // Without barriers. `list` is an address in memory with the build-input usage, 16-byte aligned.
    void record(VkCommandBuffer cmd, VkDeviceAddress list) const;

private:
    void swap(TopLevel& other) noexcept;

    const Device* device_ = nullptr;
    uint32_t instances_ = 0;
    Buffer storage_, scratch_;
    VkAccelerationStructureKHR handle_ = VK_NULL_HANDLE;
};

class Acceleration {
public:
    Acceleration() = default;
    // A list of geometries for each mesh. `instances` name their mesh in accelerationStructureReference.
    Acceleration(const Device& device, const std::vector<std::vector<TriangleRange>>& meshes,
                 std::vector<VkAccelerationStructureInstanceKHR> instances);
    ~Acceleration();
    Acceleration(Acceleration&& other) noexcept { swap(other); }
    Acceleration& operator=(Acceleration&& other) noexcept {
        swap(other);
        return *this;
    }

    VkAccelerationStructureKHR top() const { return top_.handle(); }
    const TopLevel& topLevel() const { return top_; }
    // As top() was built from it: with the addresses of the meshes.
    const std::vector<VkAccelerationStructureInstanceKHR>& instances() const { return instances_; }
    VkDeviceSize bytes() const { return meshStorage_.size() + top_.bytes(); }

private:
    void buildMeshes(const std::vector<std::vector<TriangleRange>>& meshes);
    void buildTop();
    void swap(Acceleration& other) noexcept;

    const Device* device_ = nullptr;
    Buffer meshStorage_;
    std::vector<VkAccelerationStructureKHR> meshes_;
    std::vector<VkAccelerationStructureInstanceKHR> instances_;
    TopLevel top_;
};

}   // namespace samples
