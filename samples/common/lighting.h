// What a host keeps of the SDK for a scene, whatever its views are.
#pragma once

#include <optional>

#include <restir/restir.h>

#include "common/frame_loop.h"
#include "common/gbuffer.h"

namespace samples {

// Who makes lights of a scene's emissive triangles.
enum class Emitters : uint8_t { Uploaded, Meshes };   // the host; the SDK, on the device

struct LightingDesc {
    Emitters emitters = Emitters::Uploaded;
    std::optional<restir::RayBackend> rays = {};   // unset: Device::bestRays()
    const restir::ShaderPack* shaders = nullptr;   // of `rays`; null: the library's own
};

class Lighting {
public:
    // Borrows both.
    Lighting(Device& device, GpuScene& scene, const LightingDesc& desc = {});

    // Behind GpuScene::record() of the same frame: the lights and the instances of a Bvh, where they changed.
    void record(VkCommandBuffer cmd, uint32_t slot);
    // All of a frame but its outputs. The G-buffer has the frame's extent.
    restir::FrameInput input(const Frame& frame, const GBufferPass& gbuffer) const;

    restir::Session makeSession(const restir::SessionDesc& desc) const;
    std::vector<restir::BufferInfo> memory() const;   // of the lights, and of a Bvh
    restir::RayBackend rays() const { return rays_; }
    const restir::Bvh* bvh() const { return bvh_ ? &*bvh_ : nullptr; }
    const restir::LightTable& lights() const { return lights_; }

private:
    void makeBvh();
    void upload(VkCommandBuffer cmd, uint32_t slot);

    Device& device_;
    GpuScene& scene_;
    restir::RayBackend rays_;
    restir::LightTableDesc lightsDesc_;
    restir::Context context_;
    restir::Scene sdkScene_;
    restir::LightTable lights_;
    std::optional<restir::Bvh> bvh_;
    VkDeviceSize bvhBytes_ = 0;
    uint64_t version_ = 0;   // of the scene's lights in lights_
};

}   // namespace samples
