// What of a scene changes from frame to frame, brought to the GPU in the frame's own command buffer.
#pragma once

#include <cstring>
#include <vector>

#include "common/acceleration.h"
#include "common/scene_lights.h"

namespace samples {

// Rows of an affine transform, as in RsInstance.
struct Rows {
    restir::gpu::vec4 row[3];
};

// A scene at rest, and what leads from its parts to what they came from.
struct RestingScene {
    std::vector<restir::gpu::RsInstance> records;
    std::vector<uint32_t> instanceOf;                          // of each record
    std::vector<VkAccelerationStructureInstanceKHR> entries;   // of the top level
    std::vector<uint32_t> entryInstance;                       // of each entry
    std::vector<restir::gpu::RsMaterial> materials;
    SceneLights lights;
    SceneState state;
};

Rows rowsOf(const glm::mat4& matrix);

// For RsInstance and VkTransformMatrixKHR.
template <class Row>
void copyRows(Row (&target)[3], const glm::mat4& matrix) {
    const Rows rows = rowsOf(matrix);
    static_assert(sizeof target == sizeof rows);
    std::memcpy(&target, &rows, sizeof rows);
}

class SceneMotion {
public:
    // What the frame's shaders read.
    struct Targets {
        VkBuffer instances, previousTransforms, materials, referenceLights, sky;
    };
    // Borrows both.
    SceneMotion(const Device& device, const RestingScene& rest, const Targets& targets);

    // Rewrites the targets and builds `top` behind all frames submitted before, in one queue's order. The GPU
    // is done with the slot's last use.
    void record(VkCommandBuffer cmd, uint32_t slot, const SceneState& now, const SceneState& before,
                const TopLevel& top) const;

private:
    struct Section {
        VkDeviceSize offset = 0, bytes = 0;
    };

    Section append(size_t bytes);
    void write(std::byte* staging, const SceneState& now, const SceneState& before) const;

    const RestingScene& rest_;
    Targets targets_;
    VkDeviceSize size_ = 0;
    Section records_, previous_, materials_, reference_, entries_, skyRotation_;
    Buffer staging_[FrameSlots::kCount];
};

}   // namespace samples
