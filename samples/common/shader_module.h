// Pipelines of SPIR-V: modules live as long as it takes to make one.
#pragma once

#include <span>

#include "common/device.h"

namespace samples {

VkShaderModule makeShaderModule(const Device& device, std::span<const uint32_t> spirv);
VkPipeline makeComputePipeline(const Device& device, VkPipelineLayout layout, std::span<const uint32_t> spirv);

}   // namespace samples
