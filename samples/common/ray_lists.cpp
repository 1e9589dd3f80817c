#include "common/ray_lists.h"

#include <algorithm>
#include <cmath>

#include "common/mesh_builder.h"

namespace samples {
namespace {

constexpr uint32_t kTile = 8;
constexpr float kOffset = 1e-4f;   // of the distance: off the surface that was hit
constexpr double kSame = 1e-4;     // relative difference of distances that are the same

glm::vec3 originOf(const RsLoggedRay& ray) { return {ray.originTmax.x, ray.originTmax.y, ray.originTmax.z}; }
glm::vec3 directionOf(const RsLoggedRay& ray) {
    return {ray.directionClosest.x, ray.directionClosest.y, ray.directionClosest.z};
}

}   // namespace

RsLoggedRay makeRay(const glm::vec3& origin, const glm::vec3& direction, float tmax, bool closest) {
    return {{origin.x, origin.y, origin.z, tmax},
            {direction.x, direction.y, direction.z, closest ? 1.0f : 0.0f}};
}

std::vector<RsLoggedRay> primaryRays(const CameraPose& pose, VkExtent2D extent) {
    std::vector<RsLoggedRay> rays;
    for (uint32_t tileY = 0; tileY < extent.height; tileY += kTile)
        for (uint32_t tileX = 0; tileX < extent.width; tileX += kTile)
            for (uint32_t i = 0; i < kTile * kTile; ++i) {
                const uint32_t x = tileX + i % kTile, y = tileY + i / kTile;
                if (x >= extent.width || y >= extent.height) continue;
                const glm::vec2 ndc =
                    2.0f * (glm::vec2(x, y) + 0.5f) / glm::vec2(extent.width, extent.height) - 1.0f;
                rays.push_back(
                    makeRay(pose.eye, pose.forward + ndc.x * pose.right - ndc.y * pose.up, 1e30f, true));
            }
    return rays;
}

std::vector<RsLoggedRay> scatteredRays(std::span<const RsLoggedRay> rays, std::span<const RayHit> hits,
                                       float reach, bool closest, uint32_t seed) {
    build::Rng rng(seed);
    std::vector<RsLoggedRay> result;
    for (size_t i = 0; i < rays.size(); ++i) {
        if (!hits[i].found()) continue;
        const glm::vec3 direction = directionOf(rays[i]), back = -glm::normalize(direction);
        const glm::vec3 point = originOf(rays[i]) + (1 - kOffset) * hits[i].t * direction;
        const glm::vec3 on = back + 0.99f * rng.direction();
        result.push_back(
            makeRay(point, glm::normalize(on), closest ? 1e30f : reach * rng.uniform(), closest));
    }
    return result;
}

HitComparison compareHits(std::span<const RsLoggedRay> rays, std::span<const RayHit> a,
                          std::span<const RayHit> b) {
    HitComparison result{.rays = rays.size()};
    for (size_t i = 0; i < rays.size(); ++i) {
        result.found += a[i].found() ? 1 : 0;
        if (a[i].found() != b[i].found())
            ++result.otherFound;
        else if (a[i].found() && rays[i].directionClosest.w > 0.5f) {
            const glm::vec3 o = glm::abs(originOf(rays[i]));
            const float step = glm::length(directionOf(rays[i]));
            const double difference = std::abs(double(a[i].t) - double(b[i].t)) * double(step) /
                                      double(std::max({a[i].t * step, o.x, o.y, o.z}));
            const bool same = a[i].record == b[i].record && a[i].primitive == b[i].primitive;
            if (same)
                result.largestT = std::max(result.largestT, difference);
            else
                ++(difference < kSame ? result.otherAtSame : result.otherTriangle);
        }
    }
    return result;
}

}   // namespace samples
