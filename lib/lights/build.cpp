#include <lights/build.h>

#include <algorithm>
#include <bit>
#include <vector>

#include <device/barrier.h>
#include <device/label.h>
#include <lights/tree.h>
#include <restir/shared/light_table.h>

namespace restir {
namespace {

constexpr VkPipelineStageFlags2 kCompute = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
constexpr VkAccessFlags2 kRead = VK_ACCESS_2_SHADER_STORAGE_READ_BIT,
                         kWrite = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;

VkResult makePool(LightTable::Impl& t) noexcept {
    const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 2 * RS_TABLE_BIND_COUNT};
    const VkDescriptorPoolCreateInfo info{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                                          .maxSets = 2,
                                          .poolSizeCount = 1,
                                          .pPoolSizes = &size};
    return orNull(t.device->functions.vkCreateDescriptorPool(t.device->info.device, &info,
                                                             t.device->allocator(), &t.pool),
                  t.pool);
}

void writeSet(const LightTable::Impl& t, VkDescriptorSet set, TableBuffer lights) noexcept {
    using enum TableBuffer;
    VkDescriptorBufferInfo buffers[RS_TABLE_BIND_COUNT];
    buffers[RS_TABLE_BIND_STATE].buffer = t.buffer(State);
    buffers[RS_TABLE_BIND_LIGHTS].buffer = t.buffer(lights);
    buffers[RS_TABLE_BIND_ALIAS].buffer = t.buffer(Alias);
    buffers[RS_TABLE_BIND_EXCESS].buffer = t.buffer(Excess);
    buffers[RS_TABLE_BIND_DEFICIT].buffer = t.buffer(Deficit);
    buffers[RS_TABLE_BIND_BLOCKS].buffer = t.buffer(Blocks);
    buffers[RS_TABLE_BIND_MESHES].buffer = t.buffer(Meshes);
    buffers[RS_TABLE_BIND_MEANS].buffer = t.buffer(Means);
    buffers[RS_TABLE_BIND_TREE].buffer = t.buffer(Tree);
    buffers[RS_TABLE_BIND_COUNTS].buffer = t.buffer(Counts);
    VkWriteDescriptorSet writes[RS_TABLE_BIND_COUNT];
    for (uint32_t i = 0; i < RS_TABLE_BIND_COUNT; ++i) {
        buffers[i].offset = 0;
        buffers[i].range = VK_WHOLE_SIZE;
        writes[i] = {.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                     .dstSet = set,
                     .dstBinding = i,
                     .descriptorCount = 1,
                     .descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                     .pBufferInfo = &buffers[i]};
    }
    t.device->functions.vkUpdateDescriptorSets(t.device->info.device, RS_TABLE_BIND_COUNT, writes, 0,
                                               nullptr);
}

}   // namespace

// 32 random bits choose a column, two columns at least: rsSampleLight.
VkDeviceSize aliasColumns(uint32_t lights) noexcept { return std::bit_ceil(std::max(lights, 2u)); }
VkDeviceSize aliasBlocks(uint32_t lights) noexcept {
    return (aliasColumns(lights) + RS_TABLE_BLOCK - 1) / RS_TABLE_BLOCK;
}

VkResult makeBuildSets(LightTable::Impl& t) noexcept {
    if (VkResult vk = makePool(t); vk != VK_SUCCESS) return vk;
    const VkDescriptorSetLayout layouts[] = {t.context->tableLayout, t.context->tableLayout};
    const VkDescriptorSetAllocateInfo info{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
                                           .descriptorPool = t.pool,
                                           .descriptorSetCount = 2,
                                           .pSetLayouts = layouts};
    if (VkResult vk = t.device->functions.vkAllocateDescriptorSets(t.device->info.device, &info, t.sets);
        vk != VK_SUCCESS)
        return vk;
    writeSet(t, t.sets[0], TableBuffer::Lights0);
    writeSet(t, t.sets[1], TableBuffer::Lights1);
    for (VkDescriptorSet set : t.sets)
        t.device->name(VK_OBJECT_TYPE_DESCRIPTOR_SET, handleValue(set), "light table");
    return VK_SUCCESS;
}

Result<bool> requireBuildPasses(const LightTable::Impl& t) noexcept {
    std::vector<const char*> passes = {"lights.extent", "lights.power",  "lights.sum",  "lights.scale",
                                       "lights.reduce", "lights.prefix", "lights.scan", "lights.alias"};
    if (t.meshLights > 0) passes.insert(passes.end(), {"lights.means", "lights.meshes"});
    if (t.hasTree)
        passes.insert(passes.end(), {"lights.keys", "lights.count", "lights.offsets", "lights.sort", "lights.split", "lights.nodes"});
    for (const char* pass : passes)
        if (auto made = t.context->pipelines.require(pass); !made) return made;
    return true;
}

void dispatchOfBuild(const LightTable::Impl& t, VkCommandBuffer cmd, const char* name, uint32_t groups,
                     uint32_t rows) noexcept {
    const Functions& f = t.device->functions;
    const Label label(f, cmd, name);
    f.vkCmdBindPipeline(cmd, VK_PIPELINE_BIND_POINT_COMPUTE, t.context->pipelines.of(name).pipeline);
    f.vkCmdDispatch(cmd, groups, rows, 1);
    memoryBarrier(f, cmd, {kCompute, kWrite}, {t.device->passStages, kRead | kWrite});
}

void recordBuild(LightTable::Impl& t, VkCommandBuffer cmd, uint32_t slot, const BuildInput& input) noexcept {
    const Functions& f = t.device->functions;
    const VkPipelineLayout layout = t.context->tablePipelineLayout;
    const Label label(f, cmd, "restir lights");
    const auto blocks = uint32_t(aliasBlocks(t.recorded.count));
    const uint32_t meshLights = std::min(t.meshLights, t.recorded.count);
    const gpu::RsTablePass constants{.lights = t.recorded.count,
                                     .columns = uint32_t(aliasColumns(t.recorded.count)),
                                     .blocks = blocks,
                                     .meshLights = meshLights,
                                     .meshes = t.meshes.count};
    f.vkCmdBindDescriptorSets(cmd, VK_PIPELINE_BIND_POINT_COMPUTE, layout, 0, 1, &t.sets[t.generation % 2], 0,
                              nullptr);
    f.vkCmdPushConstants(cmd, layout, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof constants, &constants);
    const auto pass = [&](const char* name, uint32_t groups, uint32_t rows = 1) {
        t.stopwatch.start(cmd, slot, name);
        dispatchOfBuild(t, cmd, name, groups, rows);
        t.stopwatch.stop(cmd, slot);
    };
    if (input.scene) {
        f.vkCmdBindDescriptorSets(cmd, VK_PIPELINE_BIND_POINT_COMPUTE, layout, RS_SET_SCENE, 1, &input.scene,
                                  0, nullptr);
        if (input.newMeshes)
            pass("lights.means", RS_TABLE_ROW, (meshLights + RS_TABLE_ROW - 1) / RS_TABLE_ROW);
        pass("lights.meshes", uint32_t(aliasBlocks(meshLights)));
    }
    if (t.recorded.infinite || t.hasTree) pass("lights.extent", blocks);
    pass("lights.power", blocks);
    pass("lights.sum", blocks);
    pass("lights.scale", 1);
    pass("lights.reduce", blocks);
    pass("lights.prefix", 1);
    pass("lights.scan", blocks);
    pass("lights.alias", blocks);
    if (t.hasTree) recordTree(t, cmd, slot, constants);
}

}   // namespace restir
