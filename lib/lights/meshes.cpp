#include <lights/meshes.h>

#include <algorithm>
#include <numeric>

namespace restir {

Status MeshPacker::pack(const MessageSink& sink, std::span<const LightMesh> meshes, PackedMeshes& packed) {
    if (meshes.size() > maxMeshes_)
        return refuse(sink, "restir: LightTable::uploadMeshes: %zu meshes, LightTableDesc::maxMeshes is %u",
                      meshes.size(), maxMeshes_);
    for (size_t i = 0; i < meshes.size(); ++i) {
        const auto [record, firstLight, triangles] = meshes[i];
        if (triangles == 0) return refuse(sink, "restir: mesh %zu (record %u): triangles is 0", i, record);
        if (uint64_t{firstLight} + triangles > meshLights_)
            return refuse(sink,
                          "restir: mesh %zu (record %u): firstLight %u + triangles %u, "
                          "LightTableDesc::meshLights is %u",
                          i, record, firstLight, triangles, meshLights_);
    }
    order_.resize(meshes.size());
    std::iota(order_.begin(), order_.end(), 0u);
    std::sort(order_.begin(), order_.end(),
              [&](uint32_t a, uint32_t b) { return meshes[a].firstLight < meshes[b].firstLight; });
    for (size_t i = 1; i < order_.size(); ++i) {
        const LightMesh &before = meshes[order_[i - 1]], &mesh = meshes[order_[i]];
        if (before.firstLight + before.triangles > mesh.firstLight)
            return refuse(sink, "restir: mesh %u (record %u): firstLight %u is a light of mesh %u, too",
                          order_[i], mesh.record, mesh.firstLight, order_[i - 1]);
    }
    list_.clear();
    for (uint32_t i : order_)
        list_.push_back({.firstLight = meshes[i].firstLight,
                         .triangles = meshes[i].triangles,
                         .record = meshes[i].record});
    packed.count = uint32_t(list_.size());
    packed.lights = list_.empty() ? 0 : list_.back().firstLight + list_.back().triangles;
    return Status::Ok;
}

}   // namespace restir
