#include <rays/pipelines.h>

#include <cstring>

namespace restir {
namespace {

// Shader groups.
constexpr uint32_t kRaygen = 0, kMiss = 1, kHit = 2, kGroups = 3;

VkRayTracingShaderGroupCreateInfoKHR groupOf(VkRayTracingShaderGroupTypeKHR type, uint32_t general, uint32_t closest,
                                             uint32_t any) noexcept {
    return {.sType = VK_STRUCTURE_TYPE_RAY_TRACING_SHADER_GROUP_CREATE_INFO_KHR,
            .type = type,
            .generalShader = general,
            .closestHitShader = closest,
            .anyHitShader = any,
            .intersectionShader = VK_SHADER_UNUSED_KHR};
}

VkResult makePipeline(const Device& device, VkPipelineLayout layout, const VkShaderModule (&shaders)[4],
                      VkPipeline& pipeline) noexcept {
    constexpr VkShaderStageFlagBits kStages[] = {VK_SHADER_STAGE_RAYGEN_BIT_KHR, VK_SHADER_STAGE_MISS_BIT_KHR,
                                                 VK_SHADER_STAGE_CLOSEST_HIT_BIT_KHR, VK_SHADER_STAGE_ANY_HIT_BIT_KHR};
    VkPipelineShaderStageCreateInfo stages[4];
    for (uint32_t i = 0; i < 4; ++i)
        stages[i] = {.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                     .stage = kStages[i],
                     .module = shaders[i],
                     .pName = "main"};
    constexpr uint32_t none = VK_SHADER_UNUSED_KHR;
    const VkRayTracingShaderGroupCreateInfoKHR groups[kGroups] = {
        groupOf(VK_RAY_TRACING_SHADER_GROUP_TYPE_GENERAL_KHR, 0, none, none),
        groupOf(VK_RAY_TRACING_SHADER_GROUP_TYPE_GENERAL_KHR, 1, none, none),
        groupOf(VK_RAY_TRACING_SHADER_GROUP_TYPE_TRIANGLES_HIT_GROUP_KHR, none, 2, 3)};
    const VkRayTracingPipelineCreateInfoKHR info{.sType = VK_STRUCTURE_TYPE_RAY_TRACING_PIPELINE_CREATE_INFO_KHR,
                                                 .stageCount = 4,
                                                 .pStages = stages,
                                                 .groupCount = kGroups,
                                                 .pGroups = groups,
                                                 .maxPipelineRayRecursionDepth = 1,
                                                 .layout = layout};
    return orNull(device.functions.vkCreateRayTracingPipelinesKHR(device.info.device, VK_NULL_HANDLE, device.info.pipelineCache,
                                                                  1, &info, device.allocator(), &pipeline),
                  pipeline);
}

VkPhysicalDeviceRayTracingPipelinePropertiesKHR propertiesOf(const Device& device) noexcept {
    VkPhysicalDeviceRayTracingPipelinePropertiesKHR rays{
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_TRACING_PIPELINE_PROPERTIES_KHR};
    VkPhysicalDeviceProperties2 properties{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, .pNext = &rays};
    device.functions.vkGetPhysicalDeviceProperties2(device.info.physicalDevice, &properties);
    return rays;
}

constexpr VkDeviceSize roundUp(VkDeviceSize value, VkDeviceSize unit) noexcept { return (value + unit - 1) / unit * unit; }

}   // namespace

VkResult makeModule(const Device& device, const ShaderPack::Module& module, VkShaderModule& shader) noexcept {
    const VkShaderModuleCreateInfo info{.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO,
                                        .codeSize = module.wordCount * sizeof(uint32_t),
                                        .pCode = module.words};
    return orNull(device.functions.vkCreateShaderModule(device.info.device, &info, device.allocator(), &shader), shader);
}

VkResult makeRayPipeline(const Device& device, VkPipelineLayout layout, const ShaderPack::Module& pass, const RayStages& stages,
                         VkPipeline& pipeline) noexcept {
    const ShaderPack::Module* modules[] = {&pass, stages.miss, stages.closestHit, stages.anyHit};
    VkShaderModule shaders[4]{};
    VkResult vk = VK_SUCCESS;
    for (uint32_t i = 0; i < 4 && vk == VK_SUCCESS; ++i) vk = makeModule(device, *modules[i], shaders[i]);
    if (vk == VK_SUCCESS) vk = makePipeline(device, layout, shaders, pipeline);
    for (VkShaderModule shader : shaders)
        if (shader) device.functions.vkDestroyShaderModule(device.info.device, shader, device.allocator());
    return vk;
}

Result<BindingTable> BindingTable::create(const Device& device, uint32_t pipelines) noexcept {
    const auto limits = propertiesOf(device);
    BindingTable table;
    // Each record is a table of its own stage, and starts where one may.
    const VkDeviceSize unit = limits.shaderGroupBaseAlignment;
    table.stride_ = roundUp(limits.shaderGroupHandleSize, unit);
    const BufferRequest request{
        .size = VkDeviceSize{kGroups} * pipelines * table.stride_ + unit,
        .usage = VK_BUFFER_USAGE_SHADER_BINDING_TABLE_BIT_KHR | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT,
        .use = MemoryUse::HostWrite,
        .name = "shader binding table"};
    auto buffers = Buffers::create(device, {&request, 1});
    if (!buffers) return buffers.error();
    table.buffers_ = std::move(*buffers);
    const VkBufferDeviceAddressInfo info{.sType = VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO,
                                         .buffer = table.buffers_.buffer(0)};
    const VkDeviceAddress start = device.functions.vkGetBufferDeviceAddress(device.info.device, &info);
    if (start == 0)
        return failure(device.sink(), Status::InvalidArgument, "the shader binding table's memory has no device address", VK_SUCCESS);
    table.address_ = roundUp(start, unit);
    table.records_ = table.buffers_.mapped<uint8_t>(0) + (table.address_ - start);
    table.handleSize_ = limits.shaderGroupHandleSize;
    return table;
}

VkResult BindingTable::set(const Device& device, uint32_t index, VkPipeline pipeline) const noexcept {
    VkResult vk = VK_SUCCESS;
    for (uint32_t group = 0; group < kGroups && vk == VK_SUCCESS; ++group)
        vk = device.functions.vkGetRayTracingShaderGroupHandlesKHR(device.info.device, pipeline, group, 1, handleSize_,
                                                                   records_ + (VkDeviceSize{kGroups} * index + group) * stride_);
    return vk;
}

void BindingTable::trace(const Device& device, VkCommandBuffer cmd, uint32_t pipeline, uint32_t width,
                         uint32_t height) const noexcept {
    VkStridedDeviceAddressRegionKHR regions[kGroups];
    for (uint32_t group = 0; group < kGroups; ++group)
        regions[group] = {.deviceAddress = address_ + (kGroups * pipeline + group) * stride_, .stride = stride_, .size = stride_};
    regions[kHit].stride = 0;   // one record for all, whatever offsets the host's instances have for pipelines of its own
    const VkStridedDeviceAddressRegionKHR callable{};
    device.functions.vkCmdTraceRaysKHR(cmd, &regions[kRaygen], &regions[kMiss], &regions[kHit], &callable, width, height, 1);
}

}   // namespace restir
