#pragma once

#include <optional>

#include <device/buffers.h>
#include <frame/context_impl.h>
#include <rays/tree.h>
#include <restir/bvh.h>

namespace restir {

// Buffers of a Bvh, in this order; a staging buffer for each frame slot follows: nodes, then instances.
enum class BvhBuffer : size_t {
    Nodes,   // over instances, of even and odd generations; then those of the meshes
    Corners0,
    Corners1,
    Corners2,
    Instances,   // of even and odd generations
    FirstSlot,
};

struct BvhSizes {
    uint64_t instances = 0;   // of one generation
    uint64_t meshNodes = 0, triangles = 0;

    uint64_t topNodes() const noexcept {
        return instances;
    }   // of one generation, one more than there can be
    uint64_t nodes() const noexcept { return 2 * topNodes() + meshNodes; }
};

struct Bvh::Impl {
    const Context::Impl* context = nullptr;
    const Device* device = nullptr;
    uint64_t serial = 0;   // tells Bvhs apart, whatever their addresses
    BvhSizes sizes;
    Buffers buffers, meshStaging;
    struct Mesh {
        uint32_t root = RS_BVH_EMPTY;   // word in the whole stream
        Box box = Box::empty();
    };
    std::vector<Mesh> meshes;
    bool meshesPending = true;                          // not recorded yet
    uint64_t generation = 0;                            // of the instances; 0: none recorded yet
    uint32_t roots[2] = {RS_BVH_EMPTY, RS_BVH_EMPTY};   // words, by parity of the generation

    // Of the last record(), kept for its memory.
    std::vector<gpu::RsBvhInstance> placed;
    std::vector<Box> boxes;
    Tree tree;

    VkBuffer buffer(BvhBuffer b) const noexcept { return buffers.buffer(size_t(b)); }
    size_t stagingOf(uint32_t slot) const noexcept { return size_t(BvhBuffer::FirstSlot) + slot; }
    uint32_t root() const noexcept { return roots[generation % 2]; }
    uint32_t previousRoot() const noexcept { return roots[1 - generation % 2]; }
};

}   // namespace restir
