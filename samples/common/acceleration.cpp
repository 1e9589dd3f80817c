#include "common/acceleration.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace samples {
namespace {

constexpr VkDeviceSize kStorageAlignment = 256;   // of an acceleration structure in its buffer
constexpr Access kBuildWrite{
    VK_PIPELINE_STAGE_2_ACCELERATION_STRUCTURE_BUILD_BIT_KHR,
    VK_ACCESS_2_ACCELERATION_STRUCTURE_WRITE_BIT_KHR | VK_ACCESS_2_ACCELERATION_STRUCTURE_READ_BIT_KHR};

// The build of one acceleration structure, with the arrays its info points to.
struct Build {
    std::vector<VkAccelerationStructureGeometryKHR> geometries;
    std::vector<VkAccelerationStructureBuildRangeInfoKHR> ranges;
    VkAccelerationStructureBuildGeometryInfoKHR info{};
    VkAccelerationStructureBuildSizesInfoKHR sizes{};

    void finish(const Device& device, VkAccelerationStructureTypeKHR type) {
        info = {.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_GEOMETRY_INFO_KHR,
                .type = type,
                .flags = VK_BUILD_ACCELERATION_STRUCTURE_PREFER_FAST_TRACE_BIT_KHR,
                .mode = VK_BUILD_ACCELERATION_STRUCTURE_MODE_BUILD_KHR,
                .geometryCount = static_cast<uint32_t>(geometries.size()),
                .pGeometries = geometries.data()};
        std::vector<uint32_t> counts;
        for (const auto& range : ranges) counts.push_back(range.primitiveCount);
        sizes = {.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_SIZES_INFO_KHR};
        device.rays().buildSizes(device.handle(), VK_ACCELERATION_STRUCTURE_BUILD_TYPE_DEVICE_KHR, &info,
                                 counts.data(), &sizes);
    }

    void record(const Device& device, VkCommandBuffer cmd) const {
        const VkAccelerationStructureBuildRangeInfoKHR* pointer = ranges.data();
        device.rays().cmdBuild(cmd, 1, &info, &pointer);
    }
};

Build meshBuild(const Device& device, const std::vector<TriangleRange>& mesh) {
    Build build;
    for (const TriangleRange& range : mesh) {
        VkAccelerationStructureGeometryKHR geometry{
            .sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR,
            .geometryType = VK_GEOMETRY_TYPE_TRIANGLES_KHR,
            .geometry = {},
            .flags = range.opaque ? VkGeometryFlagsKHR{VK_GEOMETRY_OPAQUE_BIT_KHR} : VkGeometryFlagsKHR{0}};
        geometry.geometry.triangles = {
            .sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_TRIANGLES_DATA_KHR,
            .vertexFormat = VK_FORMAT_R32G32B32_SFLOAT,
            .vertexData = {.deviceAddress = range.positions},
            .vertexStride = 3 * sizeof(float),
            .maxVertex = range.vertexCount - 1,
            .indexType = VK_INDEX_TYPE_UINT32,
            .indexData = {.deviceAddress = range.indices},
            .transformData = {}};
        build.geometries.push_back(geometry);
        build.ranges.push_back({.primitiveCount = range.triangleCount});
    }
    build.finish(device, VK_ACCELERATION_STRUCTURE_TYPE_BOTTOM_LEVEL_KHR);
    return build;
}

VkDeviceSize aligned(VkDeviceSize size) {
    return (size + kStorageAlignment - 1) / kStorageAlignment * kStorageAlignment;
}

Buffer makeStorage(const Device& device, VkDeviceSize size) {
    return {device,
            {.size = size,
             .usage = VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_STORAGE_BIT_KHR |
                      VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT}};
}

}   // namespace

Acceleration::Acceleration(const Device& device, const std::vector<std::vector<TriangleRange>>& meshes,
                           std::vector<VkAccelerationStructureInstanceKHR> instances)
    : device_(&device) {
    buildMeshes(meshes);
    buildTop(std::move(instances));
}

Acceleration::~Acceleration() {
    if (device_ == nullptr) return;
    for (VkAccelerationStructureKHR mesh : meshes_) {
        device_->rays().destroyAccelerationStructure(device_->handle(), mesh, nullptr);
    }
    device_->rays().destroyAccelerationStructure(device_->handle(), top_, nullptr);
}

void Acceleration::swap(Acceleration& other) noexcept {
    std::swap(device_, other.device_);
    std::swap(meshStorage_, other.meshStorage_);
    std::swap(topStorage_, other.topStorage_);
    std::swap(meshes_, other.meshes_);
    std::swap(top_, other.top_);
}

VkAccelerationStructureKHR Acceleration::make(const Buffer& storage, VkDeviceSize offset, VkDeviceSize size,
                                              VkAccelerationStructureTypeKHR type) const {
    const VkAccelerationStructureCreateInfoKHR info{
        .sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_CREATE_INFO_KHR,
        .buffer = storage.handle(),
        .offset = offset,
        .size = size,
        .type = type};
    VkAccelerationStructureKHR result = VK_NULL_HANDLE;
    check(device_->rays().createAccelerationStructure(device_->handle(), &info, nullptr, &result),
          "vkCreateAccelerationStructureKHR");
    return result;
}

Buffer Acceleration::makeScratch(VkDeviceSize size) const {
    return {*device_,
            {.size = size + device_->scratchAlignment(),
             .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT}};
}

VkDeviceAddress Acceleration::scratchAddress(const Buffer& scratch) const {
    const VkDeviceAddress alignment = device_->scratchAlignment();
    return (scratch.address() + alignment - 1) / alignment * alignment;
}

void Acceleration::buildMeshes(const std::vector<std::vector<TriangleRange>>& meshes) {
    std::vector<Build> builds;
    VkDeviceSize storageSize = 0, scratchSize = 0;
    for (const auto& mesh : meshes) {
        builds.push_back(meshBuild(*device_, mesh));
        // Moving a Build keeps what its info points to: the arrays stay where they are.
        storageSize += aligned(builds.back().sizes.accelerationStructureSize);
        scratchSize = std::max(scratchSize, builds.back().sizes.buildScratchSize);
    }
    meshStorage_ = makeStorage(*device_, storageSize);
    const Buffer scratch = makeScratch(scratchSize);
    VkDeviceSize offset = 0;
    for (Build& build : builds) {
        const VkDeviceSize size = build.sizes.accelerationStructureSize;
        meshes_.push_back(make(meshStorage_, offset, size, VK_ACCELERATION_STRUCTURE_TYPE_BOTTOM_LEVEL_KHR));
        offset += aligned(size);
        build.info.dstAccelerationStructure = meshes_.back();
        build.info.scratchData.deviceAddress = scratchAddress(scratch);
    }
    device_->submitAndWait([&](VkCommandBuffer cmd) {
        for (const Build& build : builds) {
            build.record(*device_, cmd);
            memoryBarrier(cmd, kBuildWrite, kBuildWrite);   // the next one uses the same scratch memory
        }
    });
}

void Acceleration::buildTop(std::vector<VkAccelerationStructureInstanceKHR> instances) {
    for (VkAccelerationStructureInstanceKHR& instance : instances) {
        const VkAccelerationStructureDeviceAddressInfoKHR info{
            .sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_DEVICE_ADDRESS_INFO_KHR,
            .accelerationStructure = meshes_[instance.accelerationStructureReference]};
        instance.accelerationStructureReference = device_->rays().deviceAddress(device_->handle(), &info);
    }
    const VkDeviceSize bytes = instances.size() * sizeof(VkAccelerationStructureInstanceKHR);
    const Buffer list(*device_,
                      {.size = bytes,
                       .usage = VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_BUILD_INPUT_READ_ONLY_BIT_KHR |
                                VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT,
                       .memory = MemoryKind::Upload});
    std::memcpy(list.mapped(), instances.data(), bytes);

    Build build;
    VkAccelerationStructureGeometryKHR geometry{
        .sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR,
        .geometryType = VK_GEOMETRY_TYPE_INSTANCES_KHR,
        .geometry = {}};
    geometry.geometry.instances = {
        .sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_INSTANCES_DATA_KHR,
        .data = {.deviceAddress = list.address()}};
    build.geometries.push_back(geometry);
    build.ranges.push_back({.primitiveCount = static_cast<uint32_t>(instances.size())});
    build.finish(*device_, VK_ACCELERATION_STRUCTURE_TYPE_TOP_LEVEL_KHR);

    const VkDeviceSize size = build.sizes.accelerationStructureSize;
    topStorage_ = makeStorage(*device_, size);
    top_ = make(topStorage_, 0, size, VK_ACCELERATION_STRUCTURE_TYPE_TOP_LEVEL_KHR);
    const Buffer scratch = makeScratch(build.sizes.buildScratchSize);
    build.info.dstAccelerationStructure = top_;
    build.info.scratchData.deviceAddress = scratchAddress(scratch);
    device_->submitAndWait([&](VkCommandBuffer cmd) { build.record(*device_, cmd); });
}

}   // namespace samples
