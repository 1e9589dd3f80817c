// What a host keeps of the SDK for a scene, whatever its views are.
#pragma once

#include <restir/restir.h>

#include "common/frame_loop.h"
#include "common/gbuffer.h"

namespace samples {

class Lighting {
public:
    // Borrows both.
    Lighting(Device& device, GpuScene& scene);

    // Behind GpuScene::record() of the same frame: the lights, where they changed.
    void record(VkCommandBuffer cmd, uint32_t slot);
    // All of a frame but its outputs. The G-buffer has the frame's extent.
    restir::FrameInput input(const Frame& frame, const GBufferPass& gbuffer) const;

    restir::Session makeSession(const restir::SessionDesc& desc) const;
    restir::BufferInfo memory() const;   // of the lights

private:
    void upload(VkCommandBuffer cmd, uint32_t slot);

    Device& device_;
    GpuScene& scene_;
    restir::Context context_;
    restir::Scene sdkScene_;
    restir::LightTable lights_;
    uint64_t version_ = 0;   // of the scene's lights in lights_
};

}   // namespace samples
