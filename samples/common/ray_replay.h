#pragma once

#include "common/scene_pass.h"

namespace samples {

// GPU milliseconds of one dispatch that traces `rays` rays of a session's log again, best of `rounds` after a first that
// compiles. Alpha tests are left out: masked triangles count as opaque. 0 where the queue has no timestamps.
double replayRays(const Device& device, const GpuScene& scene, VkBuffer rayLog, uint32_t rays, uint32_t rounds);

}   // namespace samples
