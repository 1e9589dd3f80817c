// Descriptor set and pipeline layouts, in one place with the binding numbers of restir/shared/frame.h.
#pragma once

#include <restir/shared/gi.h>

#include <frame/context_impl.h>
#include <rays/backend.h>

namespace restir {

constexpr VkDescriptorType bindingType(uint32_t binding) noexcept {
    switch (binding) {
        case RS_BIND_FRAME: return VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
        case RS_BIND_TLAS:
        case RS_BIND_PREVIOUS_TLAS: return VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR;
        case RS_BIND_LIGHT_TREE:
        case RS_BIND_BVH_NODES:
        case RS_BIND_BVH_CORNERS:
        case RS_BIND_BVH_INSTANCES: return VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
        default:
            if (binding >= RS_BIND_RADIANCE) return VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
            return binding >= RS_BIND_DEPTH ? VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE : VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    }
}

constexpr uint32_t bindingCount(uint32_t binding) noexcept {
    switch (binding) {
        case RS_BIND_RESERVOIRS: return 2;
        case RS_BIND_GI_RESERVOIRS: return 2 * RS_GI_STREAMS;
        case RS_BIND_BVH_CORNERS: return 3;
        default: return 1;
    }
}

// Whether the layout of a backend has the binding.
constexpr bool isBound(uint32_t binding, RayBackend rays) noexcept {
    switch (binding) {
        case RS_BIND_TLAS:
        case RS_BIND_PREVIOUS_TLAS: return tracesStructures(rays);
        case RS_BIND_BVH_NODES:
        case RS_BIND_BVH_CORNERS:
        case RS_BIND_BVH_INSTANCES: return rays == RayBackend::Software;
        default: return true;
    }
}

// Fills all layouts of the Context.
Result<bool> makeLayouts(Context::Impl& context, VkDescriptorSetLayout bridge) noexcept;

}   // namespace restir
