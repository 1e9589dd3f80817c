#include "common/frame_loop.h"

namespace samples {
namespace {

constexpr uint32_t kChannels = 4;
constexpr Access kCopy{VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_READ_BIT,
                       VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL};

}   // namespace

FrameLoop::FrameLoop(const Device& device, VkExtent2D extent)
    : extent_(extent),
      target_(device, extent, VK_FORMAT_R32G32B32A32_SFLOAT,
              VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT),
      slots_(device) {
    for (Buffer& buffer : readback_) {
        buffer =
            Buffer(device, {.size = VkDeviceSize{extent.width} * extent.height * kChannels * sizeof(float),
                            .usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                            .memory = MemoryKind::Readback});
    }
}

Frame FrameLoop::describe(const Sequence& sequence, uint32_t index) const {
    const auto timeOf = [&](uint32_t i) { return -static_cast<float>(sequence.frames - 1 - i); };
    const auto poseAt = [&](float time) {
        if (time == 0 || sequence.orbitDegrees == 0) return makePose(sequence.view, extent_);
        return makePose(orbit(sequence.view, sequence.orbitDegrees * time), extent_);
    };
    const float time = timeOf(index), previous = timeOf(index == 0 ? 0 : index - 1);
    return {.index = index,
            .slot = index % FrameSlots::kCount,
            .last = index + 1 == sequence.frames,
            .cut = index == 0,
            .seed = sequence.seed,
            .time = time,
            .previousTime = previous,
            .pose = poseAt(time),
            .previous = poseAt(previous),
            .jitter = sequence.jitters() ? jitterOf(index, sequence.seed) : glm::vec2(0)};
}

FloatImage FrameLoop::run(const Sequence& sequence, const FrameCallbacks& callbacks, uint32_t first) {
    sum_.assign(size_t{extent_.width} * extent_.height * 3, 0.0);
    summed_ = 0;
    std::vector<Frame> running(FrameSlots::kCount);
    for (uint32_t i = first; i < sequence.frames + FrameSlots::kCount; ++i) {
        const uint32_t slot = i % FrameSlots::kCount;
        if (i >= first + FrameSlots::kCount) {
            finish(sequence, running[slot], callbacks);
        }
        if (i >= sequence.frames) continue;
        running[slot] = describe(sequence, i);
        submit(running[slot], callbacks);
    }
    FloatImage image{extent_.width, extent_.height, {}};
    image.rgb.reserve(sum_.size());
    for (double value : sum_) image.rgb.push_back(static_cast<float>(value / summed_));
    return image;
}

void FrameLoop::submit(const Frame& frame, const FrameCallbacks& callbacks) {
    const restir::Scope& written = callbacks.written;
    const VkCommandBuffer cmd = slots_.begin(frame.slot);
    // The last frame's copy is done before this frame overwrites the target.
    pipelineBarrier(cmd, {{imageBarrier(target_, {kCopy.stages, 0, VK_IMAGE_LAYOUT_UNDEFINED},
                                        {written.stages, written.access, VK_IMAGE_LAYOUT_GENERAL})}});
    callbacks.record(cmd, frame);
    pipelineBarrier(
        cmd, {{imageBarrier(target_, {written.stages, written.access, VK_IMAGE_LAYOUT_GENERAL}, kCopy)}});
    const VkBufferImageCopy region{.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                                   .imageExtent = {extent_.width, extent_.height, 1}};
    vkCmdCopyImageToBuffer(cmd, target_.handle(), kCopy.layout, readback_[frame.slot].handle(), 1, &region);
    memoryBarrier(cmd, {VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT},
                  {VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT});
    slots_.submit(frame.slot);
}

void FrameLoop::finish(const Sequence& sequence, const Frame& frame, const FrameCallbacks& callbacks) {
    slots_.wait(frame.slot);
    const auto* pixels = reinterpret_cast<const float*>(readback_[frame.slot].mapped());
    const size_t count = size_t{extent_.width} * extent_.height;
    if (sequence.eachFrame) sequence.eachFrame(frame.index, {pixels, kChannels * count});
    if (sequence.accumulate ? frame.index >= sequence.skip : frame.last) {
        for (size_t i = 0; i < count; ++i) {
            for (size_t c = 0; c < 3; ++c) sum_[3 * i + c] += static_cast<double>(pixels[kChannels * i + c]);
        }
        ++summed_;
    }
    callbacks.finished(frame, {pixels, kChannels * count});
    if (callbacks.progress) callbacks.progress(frame.index + 1, sequence.frames);
}

}   // namespace samples
