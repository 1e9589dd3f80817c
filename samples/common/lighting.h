// What a host keeps of the SDK for a scene, whatever its views are.
#pragma once

#include <restir/restir.h>

#include "common/frame_loop.h"
#include "common/gbuffer.h"

namespace samples {

// Who makes lights of a scene's emissive triangles.
enum class Emitters : uint8_t { Uploaded, Meshes };   // the host; the SDK, on the device

class Lighting {
public:
    // Borrows both. Null shaders: the library's own.
    Lighting(Device& device, GpuScene& scene, Emitters emitters = Emitters::Uploaded,
             const restir::ShaderPack* shaders = nullptr);

    // Behind GpuScene::record() of the same frame: the lights, where they changed.
    void record(VkCommandBuffer cmd, uint32_t slot);
    // All of a frame but its outputs. The G-buffer has the frame's extent.
    restir::FrameInput input(const Frame& frame, const GBufferPass& gbuffer) const;

    restir::Session makeSession(const restir::SessionDesc& desc) const;
    restir::BufferInfo memory() const;   // of the lights
    const restir::LightTable& lights() const { return lights_; }

private:
    void upload(VkCommandBuffer cmd, uint32_t slot);

    Device& device_;
    GpuScene& scene_;
    restir::LightTableDesc lightsDesc_;
    restir::Context context_;
    restir::Scene sdkScene_;
    restir::LightTable lights_;
    uint64_t version_ = 0;   // of the scene's lights in lights_
};

}   // namespace samples
