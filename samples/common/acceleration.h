// Acceleration structures: one bottom level for each mesh, one top level.
#pragma once

#include <vector>

#include "common/gpu_memory.h"

namespace samples {

struct TriangleRange {
    VkDeviceAddress positions = 0, indices = 0;
    uint32_t vertexCount = 0, triangleCount = 0;
    bool opaque = true;
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

    VkAccelerationStructureKHR top() const { return top_; }
    VkDeviceSize bytes() const { return meshStorage_.size() + topStorage_.size(); }

private:
    void buildMeshes(const std::vector<std::vector<TriangleRange>>& meshes);
    void buildTop(std::vector<VkAccelerationStructureInstanceKHR> instances);
    VkAccelerationStructureKHR make(const Buffer& storage, VkDeviceSize offset, VkDeviceSize size,
                                    VkAccelerationStructureTypeKHR type) const;
    Buffer makeScratch(VkDeviceSize size) const;
    VkDeviceAddress scratchAddress(const Buffer& scratch) const;
    void swap(Acceleration& other) noexcept;

    const Device* device_ = nullptr;
    Buffer meshStorage_, topStorage_;
    std::vector<VkAccelerationStructureKHR> meshes_;
    VkAccelerationStructureKHR top_ = VK_NULL_HANDLE;
};

}   // namespace samples
