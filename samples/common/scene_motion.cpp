#include "common/scene_motion.h"

#include <array>
#include <cstddef>

#include "common/sky.h"

namespace samples {
namespace {

constexpr VkDeviceSize kAlignment = 16;   // of a list of instances

constexpr VkPipelineStageFlags2 kCompute = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
constexpr VkPipelineStageFlags2 kCopy = VK_PIPELINE_STAGE_2_COPY_BIT;
constexpr VkPipelineStageFlags2 kBuild = VK_PIPELINE_STAGE_2_ACCELERATION_STRUCTURE_BUILD_BIT_KHR;
constexpr VkAccessFlags2 kBuildWrite = VK_ACCESS_2_ACCELERATION_STRUCTURE_WRITE_BIT_KHR;
constexpr VkAccessFlags2 kBuildAccess = kBuildWrite | VK_ACCESS_2_ACCELERATION_STRUCTURE_READ_BIT_KHR;

}   // namespace

Rows rowsOf(const glm::mat4& matrix) {
    Rows rows;
    for (int i = 0; i < 3; ++i) rows.row[i] = {matrix[0][i], matrix[1][i], matrix[2][i], matrix[3][i]};
    return rows;
}

SceneMotion::SceneMotion(const Device& device, const RestingScene& rest, const Targets& targets)
    : rest_(rest), targets_(targets) {
    records_ = append(rest.records.size() * sizeof(rest.records[0]));
    previous_ = append(rest.records.size() * sizeof(Rows));
    materials_ = append(rest.materials.size() * sizeof(rest.materials[0]));
    reference_ = append(rest.lights.reference.size() * sizeof(ReferenceLight));
    entries_ = append(rest.entries.size() * sizeof(rest.entries[0]));
    skyRotation_ = append(sizeof(float));
    for (Buffer& buffer : staging_) {
        buffer = Buffer(
            device, {.size = size_,
                     .usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT |
                              VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_BUILD_INPUT_READ_ONLY_BIT_KHR,
                     .memory = MemoryKind::Upload});
    }
}

SceneMotion::Section SceneMotion::append(size_t bytes) {
    const Section section{size_, bytes};
    size_ += (bytes + kAlignment - 1) / kAlignment * kAlignment;
    return section;
}

void SceneMotion::write(std::byte* staging, const SceneState& now, const SceneState& before) const {
    const auto put = [&](const Section& section, const auto& values) {
        std::memcpy(staging + section.offset, values.data(), section.bytes);
    };
    std::vector<restir::gpu::RsInstance> records = rest_.records;
    std::vector<Rows> previous;
    for (size_t i = 0; i < records.size(); ++i) {
        const uint32_t instance = rest_.instanceOf[i];
        copyRows(records[i].worldFromObject, now.worldFromObject[instance]);
        previous.push_back(rowsOf(before.worldFromObject[instance]));
    }
    put(records_, records);
    put(previous_, previous);

    std::vector<restir::gpu::RsMaterial> materials = rest_.materials;
    for (size_t i = 0; i < materials.size(); ++i) {
        restir::gpu::vec3& emission = materials[i].emission;
        const float factor = now.emission[i];
        emission = {factor * emission.x, factor * emission.y, factor * emission.z};
    }
    put(materials_, materials);
    put(reference_, referenceAt(rest_.lights, now));

    // In the order of the scene at rest: lavapipe, whose builder keeps it, loses little while motion is
    // small.
    std::vector<VkAccelerationStructureInstanceKHR> entries = rest_.entries;
    for (size_t i = 0; i < entries.size(); ++i)
        copyRows(entries[i].transform.matrix, now.worldFromObject[rest_.entryInstance[i]]);
    put(entries_, entries);
    put(skyRotation_, std::array{now.skyRotation});
}

void SceneMotion::record(VkCommandBuffer cmd, uint32_t slot, const SceneState& now, const SceneState& before,
                         const TopLevel& top) const {
    const Buffer& staging = staging_[slot];
    write(staging.mapped(), now, before);
    memoryBarrier(cmd, {kCompute | kCopy | kBuild, VK_ACCESS_2_TRANSFER_WRITE_BIT | kBuildWrite},
                  {kCopy | kBuild, VK_ACCESS_2_TRANSFER_WRITE_BIT | kBuildAccess});
    const auto copy = [&](const Section& section, VkBuffer target, VkDeviceSize to = 0) {
        if (section.bytes == 0) return;
        const VkBufferCopy region{.srcOffset = section.offset, .dstOffset = to, .size = section.bytes};
        vkCmdCopyBuffer(cmd, staging.handle(), target, 1, &region);
    };
    copy(records_, targets_.instances);
    copy(previous_, targets_.previousTransforms);
    copy(materials_, targets_.materials);
    copy(reference_, targets_.referenceLights);
    copy(skyRotation_, targets_.sky, offsetof(SkyHeader, rotation));
    top.record(cmd, staging.address() + entries_.offset);
    memoryBarrier(
        cmd, {kCopy | kBuild, VK_ACCESS_2_TRANSFER_WRITE_BIT | kBuildWrite},
        {kCompute, VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_ACCELERATION_STRUCTURE_READ_BIT_KHR});
}

}   // namespace samples
