// Traces lists of rays in a scene and nothing else: what they hit by each ray backend, and what that takes.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include <restir/bvh.h>
#include <restir/shared/frame.h>

#include "common/scene_pass.h"

namespace samples {

// As RsHit in restir/rays/hit.glsl. Of rays that ask for any hit only the sign of t counts.
struct RayHit {
    float t;
    uint32_t record, primitive;
    float barycentrics[2];

    bool found() const { return t >= 0; }
};

class RayTracer {
public:
    // RayBackend::Software: in `bvh`, which has been recorded. The scene says what is opaque. Borrows all.
    RayTracer(const Device& device, const GpuScene& scene, restir::RayBackend rays,
              const restir::Bvh* bvh = nullptr);

    // `previous`: in what the Bvh held before.
    std::vector<RayHit> trace(std::span<const restir::gpu::RsLoggedRay> rays, bool previous = false);
    // GPU time of the last rays traced once more, the best of `rounds`; 0 without timestamps.
    double milliseconds(uint32_t rounds);

private:
    void record(VkCommandBuffer cmd) const;
    void makePass();

    const Device& device_;
    const GpuScene& scene_;
    restir::RayBackend backend_;
    const restir::Bvh* bvh_;
    uint32_t count_ = 0;
    bool previous_ = false;
    Buffer rays_, hits_;
    std::unique_ptr<ScenePass> pass_;
};

}   // namespace samples
