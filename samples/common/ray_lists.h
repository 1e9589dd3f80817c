// Lists of rays for RayTracer.
#pragma once

#include <vector>

#include <restir/shared/frame.h>

#include "common/camera.h"
#include "common/ray_tracer.h"

namespace samples {

using restir::gpu::RsLoggedRay;

RsLoggedRay makeRay(const glm::vec3& origin, const glm::vec3& direction, float tmax, bool closest);

// From the eye through the middle of each pixel, in tiles of 8x8 as passes have them.
std::vector<RsLoggedRay> primaryRays(const CameraPose& pose, VkExtent2D extent);
// From where those hit, in random directions around the way back: to any hit within `reach`, or to the
// closest.
std::vector<RsLoggedRay> scatteredRays(std::span<const RsLoggedRay> rays, std::span<const RayHit> hits,
                                       float reach, bool closest, uint32_t seed);

// How far two lists of hits of the same rays are apart.
struct HitComparison {
    size_t rays = 0, found = 0;
    size_t otherFound = 0;      // one hits, one does not
    size_t otherTriangle = 0;   // both hit, not the same one, and not as far away
    size_t otherAtSame = 0;     // both hit, not the same, at the same distance: an edge or a duplicate
    double largestT = 0;   // between hits of the same triangle, over the distance or the origin's coordinates
};
HitComparison compareHits(std::span<const RsLoggedRay> rays, std::span<const RayHit> a,
                          std::span<const RayHit> b);

}   // namespace samples
