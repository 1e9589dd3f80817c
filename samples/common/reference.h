// The path tracer that everything else is measured against.
#pragma once

#include "common/scene_pass.h"
#include "common/frame_loop.h"

namespace samples {

struct ReferenceSettings {
    uint32_t paths = 1;      // per pixel and frame
    uint32_t bounces = 1;    // scattering events; 1: emission plus direct light
    bool direct = true;      // off: only light scattered at least twice
    bool nextEvent = true;   // off: BSDF sampling alone, which validates the rest; blind to punctual lights
};

class ReferencePass {
public:
    // `target` in VK_IMAGE_LAYOUT_GENERAL gets each pixel's mean of the frame's paths, w: the rays they took.
    ReferencePass(const Device& device, const GpuScene& scene, VkImageView target);

    void record(VkCommandBuffer cmd, VkExtent2D extent, const Frame& frame, const ReferenceSettings& settings,
                bool jitters) const;
    restir::Scope written() const { return {pass_.stage(), VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT}; }

private:
    const GpuScene& scene_;
    ScenePass pass_;
};

class Reference {
public:
    Reference(const Device& device, GpuScene& scene, VkExtent2D extent);

    FloatImage render(const Sequence& sequence, const ReferenceSettings& settings,
                      const std::function<void(uint32_t done, uint32_t all)>& progress = {});
    double raysPerFrame() const { return raysPerFrame_; }   // of the last frame rendered

private:
    GpuScene& scene_;
    FrameLoop loop_;
    ReferencePass pass_;
    double raysPerFrame_ = 0;
};

}   // namespace samples
