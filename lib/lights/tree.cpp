#include <lights/tree.h>

#include <lights/build.h>

namespace restir {
namespace {

constexpr uint32_t kMortonBits = 30;
constexpr uint32_t kTreeWords = 12;   // a column: restir/lights/tree.glsl

}   // namespace

VkDeviceSize treeBytes(const LightTableDesc& desc) noexcept {
    return (desc.tree ? aliasColumns(desc.maxLights) : 2) * kTreeWords * sizeof(uint32_t);
}
VkDeviceSize treeCountBytes(const LightTableDesc& desc) noexcept {
    return (desc.tree ? aliasBlocks(desc.maxLights) : 1) * RS_TABLE_DIGITS * sizeof(uint32_t);
}

void recordTree(LightTable::Impl& t, VkCommandBuffer cmd, uint32_t slot,
                gpu::RsTablePass constants) noexcept {
    const auto push = [&] {
        t.device->functions.vkCmdPushConstants(cmd, t.context->tablePipelineLayout,
                                               VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof constants, &constants);
    };
    t.stopwatch.start(cmd, slot, "lights.sort");
    dispatchOfBuild(t, cmd, "lights.keys", constants.blocks);
    for (constants.shift = 0; constants.shift < kMortonBits; constants.shift += RS_TABLE_DIGIT_BITS) {
        push();
        dispatchOfBuild(t, cmd, "lights.count", constants.blocks);
        dispatchOfBuild(t, cmd, "lights.offsets", 1);
        dispatchOfBuild(t, cmd, "lights.sort", constants.blocks);
    }
    t.stopwatch.stop(cmd, slot);
    for (const char* pass : {"lights.split", "lights.nodes"}) {
        t.stopwatch.start(cmd, slot, pass);
        dispatchOfBuild(t, cmd, pass, constants.blocks);
        t.stopwatch.stop(cmd, slot);
    }
}

}   // namespace restir
