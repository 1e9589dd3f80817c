#include "common/sort_triangles.h"

#include <algorithm>
#include <numeric>

namespace samples {
namespace {

struct Range {
    size_t first, last;   // both included
};

int longestAxis(std::span<const glm::vec3> centroids, std::span<const uint32_t> order) {
    glm::vec3 low = centroids[order[0]], high = low;
    for (uint32_t i : order) {
        low = glm::min(low, centroids[i]);
        high = glm::max(high, centroids[i]);
    }
    const glm::vec3 size = high - low;
    if (size.x >= size.y && size.x >= size.z) return 0;
    return size.y >= size.z ? 1 : 2;
}

}   // namespace

std::vector<uint32_t> spatialOrder(std::span<const glm::vec3> centroids) {
    std::vector<uint32_t> order(centroids.size());
    std::iota(order.begin(), order.end(), 0u);
    if (order.size() < 3) return order;
    std::vector<Range> todo{{0, order.size() - 1}};
    while (!todo.empty()) {
        const Range range = todo.back();
        todo.pop_back();
        if (range.last - range.first <= 1) continue;
        // The driver's own halving: left child [first, middle], right child [middle + 1, last].
        const size_t middle = (range.first + range.last) / 2;
        const std::span<uint32_t> part(&order[range.first], range.last - range.first + 1);
        const int axis = longestAxis(centroids, part);
        const auto nearer = [&](uint32_t a, uint32_t b) {
            const float ca = centroids[a][axis], cb = centroids[b][axis];
            return ca < cb || (ca == cb && a < b);
        };
        const auto split = part.begin() + static_cast<std::ptrdiff_t>(middle + 1 - range.first);
        std::nth_element(part.begin(), split, part.end(), nearer);
        todo.push_back({range.first, middle});
        todo.push_back({middle + 1, range.last});
    }
    return order;
}

void sortTriangles(std::span<const glm::vec3> positions, std::vector<uint32_t>& indices) {
    std::vector<glm::vec3> centroids(indices.size() / 3, glm::vec3(0));
    for (size_t i = 0; i < centroids.size(); ++i) {
        const uint32_t* corner = &indices[3 * i];
        for (uint32_t c = 0; c < 3; ++c) centroids[i] += positions[corner[c]] / 3.0f;   // finite, whatever they are
    }
    std::vector<uint32_t> sorted;
    sorted.reserve(indices.size());
    for (uint32_t triangle : spatialOrder(centroids)) {
        for (uint32_t corner = 0; corner < 3; ++corner) sorted.push_back(indices[3 * triangle + corner]);
    }
    indices = std::move(sorted);
}

}   // namespace samples
