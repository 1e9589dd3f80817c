// The tree over the lights that are somewhere: restir/lights/tree.glsl.
#pragma once

#include <lights/table_impl.h>
#include <restir/shared/light_table.h>

namespace restir {

// Bytes of its buffers; of small ones without LightTableDesc::tree.
VkDeviceSize treeBytes(const LightTableDesc& desc) noexcept;
VkDeviceSize treeCountBytes(const LightTableDesc& desc) noexcept;

// The end of a build, whose sets are bound: sorts the lights and makes the nodes, in what the alias table's
// build no longer needs. `constants` are the build's.
void recordTree(LightTable::Impl& table, VkCommandBuffer cmd, uint32_t slot,
                gpu::RsTablePass constants) noexcept;

}   // namespace restir
