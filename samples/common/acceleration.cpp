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

Build topBuild(const Device& device, VkDeviceAddress list, uint32_t instances) {
    Build build;
    VkAccelerationStructureGeometryKHR geometry{
        .sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR,
        .geometryType = VK_GEOMETRY_TYPE_INSTANCES_KHR,
        .geometry = {}};
    geometry.geometry.instances = {
        .sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_INSTANCES_DATA_KHR,
        .data = {.deviceAddress = list}};
    build.geometries.push_back(geometry);
    build.ranges.push_back({.primitiveCount = instances});
    build.finish(device, VK_ACCELERATION_STRUCTURE_TYPE_TOP_LEVEL_KHR);
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

Buffer makeScratch(const Device& device, VkDeviceSize size) {
    return {device,
            {.size = size + device.scratchAlignment(),
             .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT}};
}

VkDeviceAddress scratchAddress(const Device& device, const Buffer& scratch) {
    const VkDeviceAddress alignment = device.scratchAlignment();
    return (scratch.address() + alignment - 1) / alignment * alignment;
}

VkAccelerationStructureKHR makeStructure(const Device& device,
                                         const VkAccelerationStructureCreateInfoKHR& info) {
    VkAccelerationStructureKHR result = VK_NULL_HANDLE;
    check(device.rays().createAccelerationStructure(device.handle(), &info, nullptr, &result),
          "vkCreateAccelerationStructureKHR");
    return result;
}

}   // namespace

TopLevel::TopLevel(const Device& device, uint32_t instances) : device_(&device), instances_(instances) {
    const Build build = topBuild(device, 0, instances);
    storage_ = makeStorage(device, build.sizes.accelerationStructureSize);
    scratch_ = makeScratch(device, build.sizes.buildScratchSize);
    handle_ = makeStructure(device, {.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_CREATE_INFO_KHR,
                                     .buffer = storage_.handle(),
                                     .size = build.sizes.accelerationStructureSize,
                                     .type = VK_ACCELERATION_STRUCTURE_TYPE_TOP_LEVEL_KHR});
}

TopLevel::~TopLevel() {
    if (device_) device_->rays().destroyAccelerationStructure(device_->handle(), handle_, nullptr);
}

void TopLevel::swap(TopLevel& other) noexcept {
    std::swap(device_, other.device_);
    std::swap(instances_, other.instances_);
    std::swap(storage_, other.storage_);
    std::swap(scratch_, other.scratch_);
    std::swap(handle_, other.handle_);
}

void TopLevel::record(VkCommandBuffer cmd, VkDeviceAddress list) const {
    Build build = topBuild(*device_, list, instances_);
    build.info.dstAccelerationStructure = handle_;
    build.info.scratchData.deviceAddress = scratchAddress(*device_, scratch_);
    build.record(*device_, cmd);
}

Acceleration::Acceleration(const Device& device, const std::vector<std::vector<TriangleRange>>& meshes,
                           std::vector<VkAccelerationStructureInstanceKHR> instances)
    : device_(&device), instances_(std::move(instances)) {
    buildMeshes(meshes);
    buildTop();
}

Acceleration::~Acceleration() {
    if (device_ == nullptr) return;
    for (VkAccelerationStructureKHR mesh : meshes_) {
        device_->rays().destroyAccelerationStructure(device_->handle(), mesh, nullptr);
    }
}

void Acceleration::swap(Acceleration& other) noexcept {
    std::swap(device_, other.device_);
    std::swap(meshStorage_, other.meshStorage_);
    std::swap(meshes_, other.meshes_);
    std::swap(instances_, other.instances_);
    std::swap(top_, other.top_);
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
    const Buffer scratch = makeScratch(*device_, scratchSize);
    VkDeviceSize offset = 0;
    for (Build& build : builds) {
        const VkDeviceSize size = build.sizes.accelerationStructureSize;
        meshes_.push_back(
            makeStructure(*device_, {.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_CREATE_INFO_KHR,
                                     .buffer = meshStorage_.handle(),
                                     .offset = offset,
                                     .size = size,
                                     .type = VK_ACCELERATION_STRUCTURE_TYPE_BOTTOM_LEVEL_KHR}));
        offset += aligned(size);
        build.info.dstAccelerationStructure = meshes_.back();
        build.info.scratchData.deviceAddress = scratchAddress(*device_, scratch);
    }
    device_->submitAndWait([&](VkCommandBuffer cmd) {
        for (const Build& build : builds) {
            build.record(*device_, cmd);
            memoryBarrier(cmd, kBuildWrite, kBuildWrite);   // the next one uses the same scratch memory
        }
    });
}

void Acceleration::buildTop() {
    for (VkAccelerationStructureInstanceKHR& instance : instances_) {
        const VkAccelerationStructureDeviceAddressInfoKHR info{
            .sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_DEVICE_ADDRESS_INFO_KHR,
            .accelerationStructure = meshes_[instance.accelerationStructureReference]};
        instance.accelerationStructureReference = device_->rays().deviceAddress(device_->handle(), &info);
    }
    const VkDeviceSize bytes = instances_.size() * sizeof(VkAccelerationStructureInstanceKHR);
    const Buffer list(*device_,
                      {.size = bytes,
                       .usage = VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_BUILD_INPUT_READ_ONLY_BIT_KHR |
                                VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT,
                       .memory = MemoryKind::Upload});
    std::memcpy(list.mapped(), instances_.data(), bytes);
    top_ = TopLevel(*device_, static_cast<uint32_t>(instances_.size()));
    device_->submitAndWait([&](VkCommandBuffer cmd) { top_.record(cmd, list.address()); });
}

}   // namespace samples
