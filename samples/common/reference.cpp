#include "common/reference.h"

#include <array>

#include "reference.spv.h"
#include "reference_raygen.spv.h"

namespace samples {
namespace {

enum Flags : uint32_t { kNextEvent = 1, kJitter = 2, kIndirect = 4 };

// Constants in reference.glsl.
struct Constants {
    CameraPose pose;
    uint32_t extent[2];
    uint32_t seed, frame, paths, bounces, lightCount, flags;
};
static_assert(sizeof(Constants) == 80);

}   // namespace

ReferencePass::ReferencePass(const Device& device, const GpuScene& scene, VkImageView target)
    : scene_(scene), pass_(device, scene, tracingShader(device, k_reference_spv, k_reference_raygen_spv), std::array{target}, sizeof(Constants)) {}

void ReferencePass::record(VkCommandBuffer cmd, VkExtent2D extent, const Frame& frame,
                           const ReferenceSettings& settings, bool jitters) const {
    pass_.record(cmd, extent,
                 Constants{.pose = frame.pose,
                           .extent = {extent.width, extent.height},
                           .seed = hash(frame.seed),
                           .frame = frame.index,
                           .paths = settings.paths,
                           .bounces = settings.bounces,
                           .lightCount = scene_.referenceLightCount(),
                           .flags = (settings.nextEvent ? kNextEvent : 0u) | (jitters ? kJitter : 0u) |
                                    (settings.direct ? 0u : kIndirect)});
}

Reference::Reference(const Device& device, GpuScene& scene, VkExtent2D extent)
    : scene_(scene), loop_(device, extent), pass_(device, scene, loop_.target()) {}

FloatImage Reference::render(const Sequence& sequence, const ReferenceSettings& settings,
                             const std::function<void(uint32_t, uint32_t)>& progress) {
    FrameCallbacks callbacks;
    callbacks.record = [&](VkCommandBuffer cmd, const Frame& frame) {
        scene_.record(cmd, frame.slot, sequence.motion, frame.time, frame.previousTime);
        pass_.record(cmd, loop_.extent(), frame, settings, sequence.jitters());
    };
    callbacks.finished = [&](const Frame&, std::span<const float> target) {
        raysPerFrame_ = 0;
        for (size_t i = 3; i < target.size(); i += 4) raysPerFrame_ += static_cast<double>(target[i]);
    };
    callbacks.progress = progress;
    callbacks.written = pass_.written();
    return loop_.run(sequence, callbacks, sequence.accumulate ? sequence.skip : sequence.frames - 1);
}

}   // namespace samples
