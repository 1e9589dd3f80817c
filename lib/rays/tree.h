// A binary tree over boxes by the surface area heuristic: of triangles and of instances alike.
#pragma once

#include <span>
#include <vector>

#include <restir/shared/bvh.h>

namespace restir {

constexpr float kLargestCoordinate = 1e18f;   // products of two stay finite

struct Box {
    float low[3], high[3];   // low > high: empty

    static Box empty() noexcept;
    void add(const Box& other) noexcept;
    void add(const float* point) noexcept;
    bool isEmpty() const noexcept { return low[0] > high[0]; }
    double area() const noexcept;   // half of the surface
    float centre(int axis) const noexcept { return 0.5f * low[axis] + 0.5f * high[axis]; }
};

struct Tree {
    std::vector<gpu::RsBvhNode> nodes;   // words and parents count from the first node
    std::vector<uint32_t> order;         // boxes in the order of the leaves, which name a range of it
    uint32_t root = RS_BVH_EMPTY;        // word
    uint32_t depth = 0;
    double cost = 0;   // BvhStatistics::cost
    Box box = Box::empty();
};

// Leaves of up to `leafSize` boxes (1 to RS_BVH_LEAF_TRIANGLES), their words with `leafFlags`. Boxes are
// finite.
void buildTree(std::span<const Box> boxes, uint32_t leafSize, uint32_t leafFlags, Tree& tree);

}   // namespace restir
