#include "common/ray_launch.h"

#include <array>

#include <closest_hit.spv.h>
#include <miss.spv.h>
#include <trace_any.spv.h>

#include "common/shader_module.h"

namespace samples {
namespace {

constexpr uint32_t kGroups = 3;   // raygen, miss, hit

struct Stage {
    VkShaderStageFlagBits stage;
    std::span<const uint32_t> spirv;
};

VkDeviceSize roundUp(VkDeviceSize value, VkDeviceSize unit) { return (value + unit - 1) / unit * unit; }

template <class Function>
Function function(const Device& device, const char* name) {
    return reinterpret_cast<Function>(vkGetDeviceProcAddr(device.handle(), name));
}

}   // namespace

RayLaunch::RayLaunch(const Device& device, VkPipelineLayout layout, std::span<const uint32_t> raygen) : device_(device) {
    try {
        makePipeline(layout, raygen);
        makeTable();
    } catch (...) {
        vkDestroyPipeline(device.handle(), pipeline_, nullptr);
        throw;
    }
}

RayLaunch::~RayLaunch() { vkDestroyPipeline(device_.handle(), pipeline_, nullptr); }

void RayLaunch::makePipeline(VkPipelineLayout layout, std::span<const uint32_t> raygen) {
    const Stage shaders[] = {{VK_SHADER_STAGE_RAYGEN_BIT_KHR, raygen},
                             {VK_SHADER_STAGE_MISS_BIT_KHR, k_miss_spv},
                             {VK_SHADER_STAGE_CLOSEST_HIT_BIT_KHR, k_closest_hit_spv},
                             {VK_SHADER_STAGE_ANY_HIT_BIT_KHR, k_trace_any_spv}};
    std::vector<VkPipelineShaderStageCreateInfo> stages;
    for (const Stage& shader : shaders)
        stages.push_back({.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                          .stage = shader.stage,
                          .module = makeShaderModule(device_, shader.spirv),
                          .pName = "main"});
    std::array<VkRayTracingShaderGroupCreateInfoKHR, kGroups> groups;
    for (uint32_t i = 0; i < kGroups; ++i) {
        const bool hit = i == kGroups - 1;
        groups[i] = {.sType = VK_STRUCTURE_TYPE_RAY_TRACING_SHADER_GROUP_CREATE_INFO_KHR,
                     .type = hit ? VK_RAY_TRACING_SHADER_GROUP_TYPE_TRIANGLES_HIT_GROUP_KHR
                                 : VK_RAY_TRACING_SHADER_GROUP_TYPE_GENERAL_KHR,
                     .generalShader = hit ? VK_SHADER_UNUSED_KHR : i,
                     .closestHitShader = hit ? 2 : VK_SHADER_UNUSED_KHR,
                     .anyHitShader = hit ? 3 : VK_SHADER_UNUSED_KHR,
                     .intersectionShader = VK_SHADER_UNUSED_KHR};
    }
    const VkRayTracingPipelineCreateInfoKHR info{
        .sType = VK_STRUCTURE_TYPE_RAY_TRACING_PIPELINE_CREATE_INFO_KHR,
        .stageCount = static_cast<uint32_t>(stages.size()),
        .pStages = stages.data(),
        .groupCount = kGroups,
        .pGroups = groups.data(),
        .maxPipelineRayRecursionDepth = 1,
        .layout = layout};
    const auto create =
        function<PFN_vkCreateRayTracingPipelinesKHR>(device_, "vkCreateRayTracingPipelinesKHR");
    const VkResult result =
        create(device_.handle(), VK_NULL_HANDLE, VK_NULL_HANDLE, 1, &info, nullptr, &pipeline_);
    for (const auto& stage : stages) vkDestroyShaderModule(device_.handle(), stage.module, nullptr);
    check(result, "vkCreateRayTracingPipelinesKHR");
}

void RayLaunch::makeTable() {
    VkPhysicalDeviceRayTracingPipelinePropertiesKHR limits{
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_TRACING_PIPELINE_PROPERTIES_KHR};
    VkPhysicalDeviceProperties2 properties{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2,
                                           .pNext = &limits};
    vkGetPhysicalDeviceProperties2(device_.physical(), &properties);
    const VkDeviceSize unit = limits.shaderGroupBaseAlignment;
    stride_ = roundUp(limits.shaderGroupHandleSize, unit);
    table_ = Buffer(device_, {.size = kGroups * stride_ + unit,
                              .usage = VK_BUFFER_USAGE_SHADER_BINDING_TABLE_BIT_KHR |
                                       VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT,
                              .memory = MemoryKind::Upload});
    address_ = roundUp(table_.address(), unit);
    auto* record = static_cast<std::byte*>(table_.mapped()) + (address_ - table_.address());
    const auto handles =
        function<PFN_vkGetRayTracingShaderGroupHandlesKHR>(device_, "vkGetRayTracingShaderGroupHandlesKHR");
    for (uint32_t i = 0; i < kGroups; ++i)
        check(handles(device_.handle(), pipeline_, i, 1, limits.shaderGroupHandleSize, record + i * stride_),
              "vkGetRayTracingShaderGroupHandlesKHR");
}

void RayLaunch::record(VkCommandBuffer cmd, VkExtent2D extent) const {
    vkCmdBindPipeline(cmd, VK_PIPELINE_BIND_POINT_RAY_TRACING_KHR, pipeline_);
    VkStridedDeviceAddressRegionKHR regions[kGroups];
    for (uint32_t i = 0; i < kGroups; ++i) regions[i] = {address_ + i * stride_, stride_, stride_};
    regions[2].stride = 0;   // one record, whatever an instance's offset
    const VkStridedDeviceAddressRegionKHR callable{};
    const auto traceRays = function<PFN_vkCmdTraceRaysKHR>(device_, "vkCmdTraceRaysKHR");
    traceRays(cmd, &regions[0], &regions[1], &regions[2], &callable, extent.width, extent.height, 1);
}

}   // namespace samples
