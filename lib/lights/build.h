// The passes that turn a LightTable's lights into a table to draw them from.
#pragma once

#include <lights/table_impl.h>

namespace restir {

// Buffers of a build, for lights below `maxLights`; `lights` of either generation come from the table.
VkDeviceSize aliasColumns(uint32_t lights) noexcept;   // a power of two
VkDeviceSize aliasBlocks(uint32_t lights) noexcept;

// A set for each generation of lights.
VkResult makeBuildSets(LightTable::Impl& table) noexcept;

// The pipelines of whatever this table's builds will dispatch.
Result<bool> requireBuildPasses(const LightTable::Impl& table) noexcept;

// What a build finds new.
struct BuildInput {
    VkDescriptorSet scene = VK_NULL_HANDLE;   // where meshes are; null: there are none
    bool newMeshes = false;
};

// One pass, with the sets and constants as they are; the next one finds what it wrote.
void dispatchOfBuild(const LightTable::Impl& table, VkCommandBuffer cmd, const char* name, uint32_t groups,
                     uint32_t rows = 1) noexcept;

// The uploaded lights are there and the state is cleared, both visible to shaders. The table is readable in
// compute shaders afterwards.
void recordBuild(LightTable::Impl& table, VkCommandBuffer cmd, uint32_t slot,
                 const BuildInput& input) noexcept;

}   // namespace restir
