// What the ray backends have in common, and what not.
#pragma once

#include <restir/device.h>

namespace restir {

constexpr bool tracesStructures(RayBackend rays) noexcept {
    return rays == RayBackend::RayQuery || rays == RayBackend::Pipeline;
}

// Of passes: those that do not trace are compute shaders with any backend.
constexpr VkShaderStageFlags shaderStages(RayBackend rays) noexcept {
    const VkShaderStageFlags ray = VK_SHADER_STAGE_RAYGEN_BIT_KHR | VK_SHADER_STAGE_ANY_HIT_BIT_KHR;
    return VK_SHADER_STAGE_COMPUTE_BIT | (rays == RayBackend::Pipeline ? ray : 0);
}
constexpr VkPipelineStageFlags2 passStages(RayBackend rays) noexcept {
    return VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT |
           (rays == RayBackend::Pipeline ? VK_PIPELINE_STAGE_2_RAY_TRACING_SHADER_BIT_KHR : VkPipelineStageFlags2{0});
}

}   // namespace restir
