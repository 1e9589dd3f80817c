#pragma once

#include <device/functions.h>
#include <restir/frame.h>

namespace restir {

inline void memoryBarrier(const Functions& f, VkCommandBuffer cmd, Scope from, Scope to) noexcept {
    const VkMemoryBarrier2 memory{.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2,
                                  .srcStageMask = from.stages,
                                  .srcAccessMask = from.access,
                                  .dstStageMask = to.stages,
                                  .dstAccessMask = to.access};
    const VkDependencyInfo info{
        .sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO, .memoryBarrierCount = 1, .pMemoryBarriers = &memory};
    f.vkCmdPipelineBarrier2(cmd, &info);
}

}   // namespace restir
