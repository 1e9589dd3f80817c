#include "support/gpu.h"

#include <cstring>

#include "common/gpu_memory.h"
#include "common/shader_module.h"

namespace tests {
namespace {

using samples::check;

VkDevice device() { return gpu().handle(); }

}   // namespace

samples::Device& gpu() {
    static samples::Device device({.validate = true});
    return device;
}

Kernel::Kernel(std::span<const uint32_t> spirv, uint32_t argumentCount) {
    makeLayouts(argumentCount);
    pipeline_ = samples::makeComputePipeline(gpu(), layout_, spirv);
    const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, argumentCount};
    const VkDescriptorPoolCreateInfo poolInfo{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                                              .maxSets = 1,
                                              .poolSizeCount = 1,
                                              .pPoolSizes = &size};
    check(vkCreateDescriptorPool(device(), &poolInfo, nullptr, &pool_), "vkCreateDescriptorPool");
    const VkDescriptorSetAllocateInfo info{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
                                           .descriptorPool = pool_,
                                           .descriptorSetCount = 1,
                                           .pSetLayouts = &setLayout_};
    check(vkAllocateDescriptorSets(device(), &info, &set_), "vkAllocateDescriptorSets");
}

Kernel::~Kernel() {
    vkDestroyDescriptorPool(device(), pool_, nullptr);
    vkDestroyPipeline(device(), pipeline_, nullptr);
    vkDestroyPipelineLayout(device(), layout_, nullptr);
    vkDestroyDescriptorSetLayout(device(), setLayout_, nullptr);
}

void Kernel::makeLayouts(uint32_t argumentCount) {
    std::vector<VkDescriptorSetLayoutBinding> bindings;
    for (uint32_t i = 0; i < argumentCount; ++i)
        bindings.push_back({i, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr});
    const VkDescriptorSetLayoutCreateInfo setInfo{
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
        .bindingCount = argumentCount,
        .pBindings = bindings.data()};
    check(vkCreateDescriptorSetLayout(device(), &setInfo, nullptr, &setLayout_),
          "vkCreateDescriptorSetLayout");
    const VkPipelineLayoutCreateInfo layoutInfo{.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                                .setLayoutCount = 1,
                                                .pSetLayouts = &setLayout_};
    check(vkCreatePipelineLayout(device(), &layoutInfo, nullptr, &layout_), "vkCreatePipelineLayout");
}

void Kernel::run(uint32_t groups, std::initializer_list<Argument> arguments) const {
    std::vector<samples::Buffer> buffers;
    std::vector<VkDescriptorBufferInfo> infos;
    for (const Argument& argument : arguments) {
        buffers.emplace_back(gpu(), samples::BufferDesc{.size = argument.bytes.size(),
                                                        .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                                                        .memory = samples::MemoryKind::Readback});
        std::memcpy(buffers.back().mapped(), argument.bytes.data(), argument.bytes.size());
        infos.push_back({buffers.back().handle(), 0, VK_WHOLE_SIZE});
    }
    const VkWriteDescriptorSet write{.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                                     .dstSet = set_,
                                     .descriptorCount = static_cast<uint32_t>(infos.size()),
                                     .descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                                     .pBufferInfo = infos.data()};
    vkUpdateDescriptorSets(device(), 1, &write, 0, nullptr);
    gpu().submitAndWait([&](VkCommandBuffer cmd) {
        vkCmdBindPipeline(cmd, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_);
        vkCmdBindDescriptorSets(cmd, VK_PIPELINE_BIND_POINT_COMPUTE, layout_, 0, 1, &set_, 0, nullptr);
        vkCmdDispatch(cmd, groups, 1, 1);
        samples::memoryBarrier(cmd,
                               {VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT},
                               {VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT});
    });
    size_t i = 0;
    for (const Argument& argument : arguments) {
        if (argument.returned) std::memcpy(argument.bytes.data(), buffers[i].mapped(), argument.bytes.size());
        ++i;
    }
}

}   // namespace tests
