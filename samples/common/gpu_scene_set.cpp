// The descriptor set that scene.glsl declares.
#include <array>

#include "common/gpu_scene.h"

namespace samples {
namespace {

enum Binding : uint32_t {
    kTlas,
    kInstances,
    kMaterials,
    kReferenceLights,
    kPreviousTransforms,
    kSky,
    kTextures,
    kBindingCount
};

VkDescriptorSetLayoutBinding binding(uint32_t index, VkDescriptorType type, uint32_t count = 1) {
    return {.binding = index,
            .descriptorType = type,
            .descriptorCount = count,
            .stageFlags = VK_SHADER_STAGE_COMPUTE_BIT};
}

}   // namespace

void GpuScene::makeSet() {
    const auto textureCount = static_cast<uint32_t>(textureInfos_.size());
    std::array bindings = {
        binding(kTlas, VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR),
        binding(kInstances, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER),
        binding(kMaterials, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER),
        binding(kReferenceLights, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER),
        binding(kPreviousTransforms, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER),
        binding(kSky, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER),
        binding(kTextures, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, std::max(textureCount, 1u))};
    for (VkDescriptorSetLayoutBinding& each : bindings)
        if (device_.hasRayPipelines())
            each.stageFlags |= VK_SHADER_STAGE_RAYGEN_BIT_KHR | VK_SHADER_STAGE_ANY_HIT_BIT_KHR;
    std::array<VkDescriptorBindingFlags, kBindingCount> flags{};
    flags[kTextures] = VK_DESCRIPTOR_BINDING_PARTIALLY_BOUND_BIT;   // scenes without textures
    const VkDescriptorSetLayoutBindingFlagsCreateInfo flagsInfo{
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_BINDING_FLAGS_CREATE_INFO,
        .bindingCount = kBindingCount,
        .pBindingFlags = flags.data()};
    const VkDescriptorSetLayoutCreateInfo layoutInfo{
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
        .pNext = &flagsInfo,
        .bindingCount = kBindingCount,
        .pBindings = bindings.data()};
    check(vkCreateDescriptorSetLayout(device_.handle(), &layoutInfo, nullptr, &setLayout_),
          "vkCreateDescriptorSetLayout");
    std::array<VkDescriptorPoolSize, kBindingCount> sizes;
    for (size_t i = 0; i < sizes.size(); ++i)
        sizes[i] = {bindings[i].descriptorType, 2 * bindings[i].descriptorCount};
    const VkDescriptorPoolCreateInfo poolInfo{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                                              .maxSets = 2,
                                              .poolSizeCount = kBindingCount,
                                              .pPoolSizes = sizes.data()};
    check(vkCreateDescriptorPool(device_.handle(), &poolInfo, nullptr, &pool_), "vkCreateDescriptorPool");
    const VkDescriptorSetLayout layouts[] = {setLayout_, setLayout_};
    const VkDescriptorSetAllocateInfo allocation{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
                                                 .descriptorPool = pool_,
                                                 .descriptorSetCount = 2,
                                                 .pSetLayouts = layouts};
    check(vkAllocateDescriptorSets(device_.handle(), &allocation, sets_), "vkAllocateDescriptorSets");
    writeSet(0);
}

void GpuScene::writeSet(uint32_t index) const {
    const VkAccelerationStructureKHR structure = top(index).handle();
    const VkWriteDescriptorSetAccelerationStructureKHR topInfo{
        .sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET_ACCELERATION_STRUCTURE_KHR,
        .accelerationStructureCount = 1,
        .pAccelerationStructures = &structure};
    const std::array<VkDescriptorBufferInfo, 5> buffers = {
        {{instances_.handle(), 0, VK_WHOLE_SIZE},
         {materials_.handle(), 0, VK_WHOLE_SIZE},
         {referenceLights_.handle(), 0, VK_WHOLE_SIZE},
         {previousTransforms_.handle(), 0, VK_WHOLE_SIZE},
         {sky_.handle(), 0, VK_WHOLE_SIZE}}};
    std::array<VkWriteDescriptorSet, kBindingCount> writes;
    for (uint32_t i = 0; i < writes.size(); ++i) {
        writes[i] = {.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                     .dstSet = sets_[index],
                     .dstBinding = i,
                     .descriptorCount = 1,
                     .descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER};
        if (i >= kInstances && i <= kSky) writes[i].pBufferInfo = &buffers[i - kInstances];
    }
    writes[kTlas].pNext = &topInfo;
    writes[kTlas].descriptorType = VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR;
    writes[kTextures].descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    writes[kTextures].descriptorCount = static_cast<uint32_t>(textureInfos_.size());
    writes[kTextures].pImageInfo = textureInfos_.data();
    const uint32_t count = textureInfos_.empty() ? kTextures : kBindingCount;   // none: nothing to write
    vkUpdateDescriptorSets(device_.handle(), count, writes.data(), 0, nullptr);
}

}   // namespace samples
