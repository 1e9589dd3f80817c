#pragma once

#include <memory>
#include <span>

#include <restir/context.h>
#include <restir/shared/bvh.h>

namespace restir {

// Triangles of one material in a mesh, as a VkAccelerationStructureGeometryKHR has them.
struct BvhGeometry {
    std::span<const float> positions;    // 3 floats a vertex, object space
    std::span<const uint32_t> indices;   // 3 a triangle; primitive i is indices 3i to 3i + 2
    bool opaque = true;                  // false: rsBridgeOpaque() decides each hit (alpha test)
};

struct BvhMeshDesc {
    std::span<const BvhGeometry> geometries;   // numbered as geometryIndex is; only read during create()
    MessageSink messages = {};
};

struct BvhStatistics {
    uint64_t triangles = 0;   // that rays can hit
    uint64_t ignored = 0;     // without area, not finite, or beyond 1e18
    uint64_t nodes = 0;
    uint32_t depth = 0;   // nodes on the longest way down, at most 32
    // Nodes and triangles that a random ray through the mesh's box tests, a node (two boxes) counted as one
    // test: the surface area heuristic. Compare orders and builders of one mesh by it.
    double cost = 0;
};

// The tree over one mesh's triangles, built and kept on the CPU: no device, no Context. Any number of threads
// may build meshes at a time, about 2 us a triangle.
class BvhMesh {
public:
    // InvalidArgument: an index beyond the vertices, or more than 2^28 triangles.
    static Result<BvhMesh> create(const BvhMeshDesc& desc) noexcept;
    BvhMesh(BvhMesh&&) noexcept;
    BvhMesh& operator=(BvhMesh&&) noexcept;
    ~BvhMesh();

    const BvhStatistics& statistics() const noexcept;

    struct Impl;

private:
    friend struct Internals;
    explicit BvhMesh(std::unique_ptr<Impl> impl) noexcept;
    std::unique_ptr<Impl> impl_;
};

struct BvhDesc {
    std::span<const BvhMesh> meshes;   // only read during create()
    uint32_t maxInstances = 0;         // 256 bytes each on the device, 128 a frame in flight
};

// A mesh placed in the world. Instances that rays should not find are left out of the list.
struct BvhInstance {
    uint32_t mesh = 0;     // in BvhDesc::meshes
    uint32_t record = 0;   // of its first geometry in SceneDesc::instances, as instanceCustomIndex
    // Rows of an affine transform, as VkTransformMatrixKHR. Finite. One that flattens the mesh takes it out
    // of the scene.
    float worldFromObject[3][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};
};

// What a host's own shaders trace in, with shaders/restir/rays/software.glsl. Storage buffers of structs in
// restir/shared/bvh.h.
struct BvhBuffers {
    VkBuffer nodes = VK_NULL_HANDLE;        // gpu::RsBvhNode[]
    VkBuffer corners[3] = {};               // gpu::RsBvhCorner[] each
    VkBuffer instances = VK_NULL_HANDLE;    // gpu::RsBvhInstance[]
    uint32_t root = RS_BVH_EMPTY;           // word of the tree over this frame's instances
    uint32_t previousRoot = RS_BVH_EMPTY;   // and over those that it replaced; of two in turns
};

// What rays hit with RayBackend::Software, in place of acceleration structures: meshes that stay, and
// instances of them, this frame's and the last one's. Shared by any number of Sessions; externally
// synchronised. Frames that read it are submitted in recording order on one queue of
// ContextDesc::queueFamily. For other meshes make another one.
class Bvh {
public:
    static Result<Bvh> create(const Context& context, const BvhDesc& desc) noexcept;
    // Exactly what create() will ask for, in bytes: 64 a node and 48 a triangle on the device, as much again
    // for staging.
    static VkDeviceSize memoryNeeded(const Context& context, const BvhDesc& desc) noexcept;
    Bvh(Bvh&&) noexcept;
    Bvh& operator=(Bvh&&) noexcept;
    ~Bvh();   // the GPU is done with its last frame

    // All instances of this frame; those not named are gone. Builds the tree over them on the CPU, about 1 us
    // an instance, and records its copy, the first time that of the meshes, too; outside any render pass,
    // before Session::record. Needed only when something moved, at most once a frame: what it replaces is
    // last frame's, which VisibilityReuse::Traced asks for, and a Session whose last frame was more than one
    // record() ago drops its history. The GPU is done with the slot's last use; the list is read during the
    // call. On an error nothing was recorded, and the instances stay.
    [[nodiscard]] Status record(VkCommandBuffer cmd, uint32_t frameSlot,
                                std::span<const BvhInstance> instances) noexcept;

    // As of the last record(), for commands between that and the next one. Compute shaders may read them at
    // once, and the next record() waits for those only.
    BvhBuffers buffers() const noexcept;

    // Gives back the staging memory of the meshes, half of theirs, once the GPU is done with the first
    // record().
    void releaseStaging() noexcept;

    struct Impl;

private:
    friend struct Internals;
    explicit Bvh(std::unique_ptr<Impl> impl) noexcept;
    std::unique_ptr<Impl> impl_;
};

}   // namespace restir
