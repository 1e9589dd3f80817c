#include <rays/mesh_impl.h>

#include <cmath>

#include <device/internals.h>
#include <device/messages.h>

namespace restir {
namespace {

constexpr uint64_t kMaxTriangles = RS_BVH_INDEX;

struct Triangle {
    uint32_t geometry, primitive;
};

Status check(const BvhMeshDesc& desc) noexcept {
    uint64_t triangles = 0;
    for (size_t g = 0; g < desc.geometries.size(); ++g) {
        const BvhGeometry& geometry = desc.geometries[g];
        if (geometry.indices.size() % 3 != 0)
            return refuse(desc.messages,
                          "restir: BvhGeometry::indices of geometry %zu has %zu indices, not 3 a triangle", g,
                          geometry.indices.size());
        const size_t vertices = geometry.positions.size() / 3;
        for (size_t i = 0; i < geometry.indices.size(); ++i)
            if (geometry.indices[i] >= vertices)
                return refuse(desc.messages,
                              "restir: BvhGeometry::indices of geometry %zu is %u at triangle %zu, there are "
                              "%zu vertices",
                              g, geometry.indices[i], i / 3, vertices);
        triangles += geometry.indices.size() / 3;
    }
    if (desc.geometries.size() >= RS_BVH_NOT_OPAQUE)
        return refuse(desc.messages, "restir: BvhMeshDesc::geometries has %zu entries",
                      desc.geometries.size());
    if (triangles > kMaxTriangles)
        return refuse(desc.messages, "restir: BvhMeshDesc::geometries has %llu triangles, at most %llu",
                      static_cast<unsigned long long>(triangles),
                      static_cast<unsigned long long>(kMaxTriangles));
    return Status::Ok;
}

const float* cornerOf(const BvhGeometry& geometry, uint32_t primitive, uint32_t corner) noexcept {
    return geometry.positions.data() + size_t{3} * geometry.indices[size_t{3} * primitive + corner];
}

bool canBeHit(const BvhGeometry& geometry, uint32_t primitive) noexcept {
    const float* p[3];
    for (uint32_t i = 0; i < 3; ++i) {
        p[i] = cornerOf(geometry, primitive, i);
        for (int axis = 0; axis < 3; ++axis)
            if (!(std::abs(p[i][axis]) <= kLargestCoordinate)) return false;
    }
    double a[3], b[3];
    for (int axis = 0; axis < 3; ++axis) {
        a[axis] = double(p[1][axis]) - p[0][axis];
        b[axis] = double(p[2][axis]) - p[0][axis];
    }
    return a[1] * b[2] != a[2] * b[1] || a[2] * b[0] != a[0] * b[2] || a[0] * b[1] != a[1] * b[0];
}

void writeCorners(const BvhMeshDesc& desc, std::span<const Triangle> triangles, const Tree& tree,
                  BvhMesh::Impl& mesh) {
    for (auto& corners : mesh.corners) corners.reserve(triangles.size());
    for (uint32_t i : tree.order) {
        const Triangle t = triangles[i];
        const BvhGeometry& geometry = desc.geometries[t.geometry];
        const uint32_t ids[3] = {t.primitive, t.geometry | (geometry.opaque ? 0 : RS_BVH_NOT_OPAQUE), 0};
        for (uint32_t corner = 0; corner < 3; ++corner) {
            const float* p = cornerOf(geometry, t.primitive, corner);
            mesh.corners[corner].push_back({.position = {p[0], p[1], p[2]}, .id = ids[corner]});
        }
    }
}

}   // namespace

BvhMesh::BvhMesh(std::unique_ptr<Impl> impl) noexcept : impl_(std::move(impl)) {}
BvhMesh::BvhMesh(BvhMesh&&) noexcept = default;
BvhMesh& BvhMesh::operator=(BvhMesh&&) noexcept = default;
BvhMesh::~BvhMesh() = default;

Result<BvhMesh> BvhMesh::create(const BvhMeshDesc& desc) noexcept {
    if (Status s = check(desc); s != Status::Ok) return Error{s, VK_SUCCESS, "BvhMeshDesc is invalid"};
    std::vector<Triangle> triangles;
    std::vector<Box> boxes;
    uint64_t all = 0;
    for (uint32_t g = 0; g < desc.geometries.size(); ++g) {
        const BvhGeometry& geometry = desc.geometries[g];
        const auto count = uint32_t(geometry.indices.size() / 3);
        all += count;
        for (uint32_t primitive = 0; primitive < count; ++primitive) {
            if (!canBeHit(geometry, primitive)) continue;
            triangles.push_back({g, primitive});
            Box& box = boxes.emplace_back(Box::empty());
            for (uint32_t i = 0; i < 3; ++i) box.add(cornerOf(geometry, primitive, i));
        }
    }
    auto mesh = std::make_unique<Impl>();
    Tree tree;
    buildTree(boxes, RS_BVH_LEAF_TRIANGLES, 0, tree);
    writeCorners(desc, triangles, tree, *mesh);
    mesh->root = tree.root;
    mesh->box = tree.box;
    mesh->statistics = {.triangles = triangles.size(),
                        .ignored = all - triangles.size(),
                        .nodes = tree.nodes.size(),
                        .depth = tree.depth,
                        .cost = tree.cost};
    mesh->nodes = std::move(tree.nodes);
    return BvhMesh(std::move(mesh));
}

const BvhStatistics& BvhMesh::statistics() const noexcept { return impl_->statistics; }

}   // namespace restir
