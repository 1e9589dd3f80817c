#include "common/scene_pass.h"

#include <cmath>

#include "common/shader_module.h"

namespace samples {
namespace {

constexpr uint32_t kGroupSize = 8;

}   // namespace

PassShader tracingShader(const Device& device, std::span<const uint32_t> query, std::span<const uint32_t> raygen) {
    return device.hasRayQuery() ? PassShader(query) : PassShader(raygen, true);
}

ScenePass::ScenePass(const Device& device, const GpuScene& scene, const PassShader& shader,
                     std::span<const VkImageView> images, uint32_t constantsSize, std::span<const VkBuffer> buffers)
    : device_(device),
      scene_(scene),
      stages_(shader.raygen ? VK_SHADER_STAGE_RAYGEN_BIT_KHR : VK_SHADER_STAGE_COMPUTE_BIT) {
    try {
        makeSet(images, buffers);
        makeLayout(constantsSize);
        if (shader.raygen) launch_ = std::make_unique<RayLaunch>(device, layout_, shader.spirv);
        else pipeline_ = makeComputePipeline(device, layout_, shader.spirv);
    } catch (...) {
        release();
        throw;
    }
}

ScenePass::~ScenePass() { release(); }

void ScenePass::release() {
    vkDestroyPipeline(device_.handle(), pipeline_, nullptr);
    vkDestroyPipelineLayout(device_.handle(), layout_, nullptr);
    vkDestroyDescriptorPool(device_.handle(), pool_, nullptr);
    vkDestroyDescriptorSetLayout(device_.handle(), setLayout_, nullptr);
}

void ScenePass::makeSet(std::span<const VkImageView> images, std::span<const VkBuffer> buffers) {
    std::vector<VkDescriptorSetLayoutBinding> bindings;
    std::vector<VkDescriptorImageInfo> imageInfos;
    std::vector<VkDescriptorBufferInfo> bufferInfos;
    std::vector<VkDescriptorPoolSize> sizes;
    const auto bind = [&](VkDescriptorType type) {
        bindings.push_back({.binding = static_cast<uint32_t>(bindings.size()),
                            .descriptorType = type,
                            .descriptorCount = 1,
                            .stageFlags = stages_});
        sizes.push_back({type, 1});
    };
    for (VkImageView view : images) {
        bind(VK_DESCRIPTOR_TYPE_STORAGE_IMAGE);
        imageInfos.push_back({.imageView = view, .imageLayout = VK_IMAGE_LAYOUT_GENERAL});
    }
    for (VkBuffer buffer : buffers) {
        bind(VK_DESCRIPTOR_TYPE_STORAGE_BUFFER);
        bufferInfos.push_back({.buffer = buffer, .range = VK_WHOLE_SIZE});
    }
    const VkDescriptorSetLayoutCreateInfo layoutInfo{
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
        .bindingCount = static_cast<uint32_t>(bindings.size()),
        .pBindings = bindings.data()};
    check(vkCreateDescriptorSetLayout(device_.handle(), &layoutInfo, nullptr, &setLayout_),
          "vkCreateDescriptorSetLayout");
    const VkDescriptorPoolCreateInfo poolInfo{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                                              .maxSets = 1,
                                              .poolSizeCount = static_cast<uint32_t>(sizes.size()),
                                              .pPoolSizes = sizes.data()};
    check(vkCreateDescriptorPool(device_.handle(), &poolInfo, nullptr, &pool_), "vkCreateDescriptorPool");
    const VkDescriptorSetAllocateInfo allocation{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
                                                 .descriptorPool = pool_,
                                                 .descriptorSetCount = 1,
                                                 .pSetLayouts = &setLayout_};
    check(vkAllocateDescriptorSets(device_.handle(), &allocation, &set_), "vkAllocateDescriptorSets");
    std::vector<VkWriteDescriptorSet> writes;
    for (uint32_t i = 0; i < bindings.size(); ++i) {
        const bool image = i < imageInfos.size();
        writes.push_back({.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                          .dstSet = set_,
                          .dstBinding = i,
                          .descriptorCount = 1,
                          .descriptorType = bindings[i].descriptorType,
                          .pImageInfo = image ? &imageInfos[i] : nullptr,
                          .pBufferInfo = image ? nullptr : &bufferInfos[i - imageInfos.size()]});
    }
    vkUpdateDescriptorSets(device_.handle(), static_cast<uint32_t>(writes.size()), writes.data(), 0, nullptr);
}

VkPipelineStageFlags2 ScenePass::stage() const {
    return launch_ ? VK_PIPELINE_STAGE_2_RAY_TRACING_SHADER_BIT_KHR : VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
}

void ScenePass::makeLayout(uint32_t constantsSize) {
    const VkDescriptorSetLayout sets[] = {setLayout_, scene_.setLayout()};
    const VkPushConstantRange range{stages_, 0, constantsSize};
    const VkPipelineLayoutCreateInfo layoutInfo{.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                                .setLayoutCount = 2,
                                                .pSetLayouts = sets,
                                                .pushConstantRangeCount = 1,
                                                .pPushConstantRanges = &range};
    check(vkCreatePipelineLayout(device_.handle(), &layoutInfo, nullptr, &layout_), "vkCreatePipelineLayout");
}

// Groups of compute in a square: 65,535 are the most in a row.
VkExtent2D ScenePass::listExtent(uint32_t items) const {
    if (launch_) return {items, 1};
    const double groups = std::ceil(double(items) / (kGroupSize * kGroupSize));
    const auto side = static_cast<uint32_t>(std::ceil(std::sqrt(groups)));
    return {kGroupSize * side, kGroupSize * side};
}

void ScenePass::run(VkCommandBuffer cmd, VkExtent2D extent, std::span<const std::byte> constants) const {
    const VkDescriptorSet sets[] = {set_, scene_.set()};
    const VkPipelineBindPoint point = launch_ ? VK_PIPELINE_BIND_POINT_RAY_TRACING_KHR : VK_PIPELINE_BIND_POINT_COMPUTE;
    vkCmdBindDescriptorSets(cmd, point, layout_, 0, 2, sets, 0, nullptr);
    vkCmdPushConstants(cmd, layout_, stages_, 0, static_cast<uint32_t>(constants.size()), constants.data());
    if (launch_) return launch_->record(cmd, extent);
    vkCmdBindPipeline(cmd, point, pipeline_);
    vkCmdDispatch(cmd, (extent.width + kGroupSize - 1) / kGroupSize,
                  (extent.height + kGroupSize - 1) / kGroupSize, 1);
}

}   // namespace samples
