#include <frame/layouts.h>

#include <restir/shared/light_table.h>

namespace restir {
namespace {

VkResult makeSetLayout(const Device& device, std::span<const VkDescriptorSetLayoutBinding> bindings,
                       std::span<const VkDescriptorBindingFlags> flags, VkDescriptorSetLayout& layout) noexcept {
    const VkDescriptorSetLayoutBindingFlagsCreateInfo flagInfo{
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_BINDING_FLAGS_CREATE_INFO,
        .bindingCount = uint32_t(flags.size()),
        .pBindingFlags = flags.data()};
    const VkDescriptorSetLayoutCreateInfo info{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
                                               .pNext = &flagInfo,
                                               .bindingCount = uint32_t(bindings.size()),
                                               .pBindings = bindings.data()};
    return orNull(device.functions.vkCreateDescriptorSetLayout(device.info.device, &info, device.allocator(), &layout), layout);
}

VkResult makeFrameLayout(Context::Impl& c) noexcept {
    VkDescriptorSetLayoutBinding bindings[RS_BIND_COUNT];
    VkDescriptorBindingFlags flags[RS_BIND_COUNT];
    uint32_t count = 0;
    for (uint32_t i = 0; i < RS_BIND_COUNT; ++i) {
        if (!isBound(i, c.rays)) continue;
        bindings[count] = {.binding = i,
                           .descriptorType = bindingType(i),
                           .descriptorCount = bindingCount(i),
                           .stageFlags = shaderStages(c.rays)};
        flags[count++] = VK_DESCRIPTOR_BINDING_PARTIALLY_BOUND_BIT;   // absent images stay unbound behind a flag
    }
    return makeSetLayout(c.device, {bindings, count}, {flags, count}, c.frameLayout);
}

VkResult makeSceneLayout(Context::Impl& c) noexcept {
    const VkDescriptorSetLayoutBinding bindings[] = {
        {.binding = RS_SCENE_BIND_INSTANCES,
         .descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
         .descriptorCount = 1,
         .stageFlags = shaderStages(c.rays)},
        {.binding = RS_SCENE_BIND_MATERIALS,
         .descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
         .descriptorCount = 1,
         .stageFlags = shaderStages(c.rays)},
        {.binding = RS_SCENE_BIND_TEXTURES,
         .descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
         .descriptorCount = c.maxTextures,
         .stageFlags = shaderStages(c.rays)},
    };
    const VkDescriptorBindingFlags flags[] = {0, 0, VK_DESCRIPTOR_BINDING_PARTIALLY_BOUND_BIT};
    c.ownsSceneLayout = true;
    return makeSetLayout(c.device, bindings, flags, c.sceneLayout);
}

VkResult makeTableLayout(Context::Impl& c) noexcept {
    VkDescriptorSetLayoutBinding bindings[RS_TABLE_BIND_COUNT];
    for (uint32_t i = 0; i < RS_TABLE_BIND_COUNT; ++i)
        bindings[i] = {.binding = i,
                       .descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                       .descriptorCount = 1,
                       .stageFlags = VK_SHADER_STAGE_COMPUTE_BIT};
    const VkDescriptorBindingFlags flags[RS_TABLE_BIND_COUNT] = {};
    return makeSetLayout(c.device, bindings, flags, c.tableLayout);
}

VkResult makePipelineLayout(const Context::Impl& c, std::span<const VkDescriptorSetLayout> sets,
                            const VkPushConstantRange& push, VkPipelineLayout& layout) noexcept {
    const VkPipelineLayoutCreateInfo info{.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                          .setLayoutCount = uint32_t(sets.size()),
                                          .pSetLayouts = sets.data(),
                                          .pushConstantRangeCount = 1,
                                          .pPushConstantRanges = &push};
    return orNull(c.device.functions.vkCreatePipelineLayout(c.device.info.device, &info, c.device.allocator(), &layout), layout);
}

VkResult makePipelineLayouts(Context::Impl& c) noexcept {
    const VkDescriptorSetLayout frame[] = {c.frameLayout, c.sceneLayout};
    if (VkResult vk = makePipelineLayout(c, frame, {.stageFlags = shaderStages(c.rays), .size = sizeof(gpu::RsPass)}, c.pipelineLayout); vk != VK_SUCCESS) return vk;
    const VkDescriptorSetLayout table[] = {c.tableLayout, c.sceneLayout};
    return makePipelineLayout(c, table, {.stageFlags = VK_SHADER_STAGE_COMPUTE_BIT, .size = sizeof(gpu::RsTablePass)},
                              c.tablePipelineLayout);
}

}   // namespace

Result<bool> makeLayouts(Context::Impl& c, VkDescriptorSetLayout bridge) noexcept {
    const MessageSink& sink = c.device.sink();
    if (VkResult vk = makeFrameLayout(c); vk != VK_SUCCESS)
        return failure(sink, Status::DeviceError, "creating the frame's set layout failed", vk);
    c.sceneLayout = bridge;
    if (!bridge)
        if (VkResult vk = makeSceneLayout(c); vk != VK_SUCCESS)
            return failure(sink, Status::DeviceError, "creating the scene's set layout failed", vk);
    if (VkResult vk = makeTableLayout(c); vk != VK_SUCCESS)
        return failure(sink, Status::DeviceError, "creating the light table's set layout failed", vk);
    if (VkResult vk = makePipelineLayouts(c); vk != VK_SUCCESS)
        return failure(sink, Status::DeviceError, "creating the pipeline layouts failed", vk);
    return true;
}

}   // namespace restir
