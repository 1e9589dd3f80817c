// Orders primitives for drivers that do not.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace samples {

// An order of `centroids` in which halving the index range again and again makes a k-d tree. Lavapipe's
// acceleration structure builder halves and never sorts, which costs up to 100 times the traversal time;
// builders that sort for themselves do not mind.
std::vector<uint32_t> spatialOrder(std::span<const glm::vec3> centroids);

// Reorders triangles (three indices each) that way; a deterministic function of its arguments.
void sortTriangles(std::span<const glm::vec3> positions, std::vector<uint32_t>& indices);

}   // namespace samples
