#pragma once

#include <vector>

#include <rays/tree.h>
#include <restir/bvh.h>

namespace restir {

struct BvhMesh::Impl {
    std::vector<gpu::RsBvhNode> nodes;          // words and parents count from the first of this mesh
    std::vector<gpu::RsBvhCorner> corners[3];   // of each triangle, in the order of the leaves
    uint32_t root = RS_BVH_EMPTY;
    Box box = Box::empty();
    BvhStatistics statistics;
};

}   // namespace restir
