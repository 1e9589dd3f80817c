// A host's list of meshes, checked and brought into the order of their ids.
#pragma once

#include <span>
#include <vector>

#include <device/messages.h>
#include <restir/lights.h>
#include <restir/shared/light_table.h>

namespace restir {

struct PackedMeshes {
    uint32_t count = 0;    // of meshes
    uint32_t lights = 0;   // one more than the largest id
};

class MeshPacker {
public:
    MeshPacker(uint32_t maxMeshes, uint32_t meshLights) : maxMeshes_(maxMeshes), meshLights_(meshLights) {
        order_.reserve(maxMeshes);
        list_.reserve(maxMeshes);
    }

    // Names the mesh and the field if one is bad; `packed` and the last list() are then as before.
    Status pack(const MessageSink& sink, std::span<const LightMesh> meshes, PackedMeshes& packed);
    std::span<const gpu::RsLightMesh> list() const { return list_; }

private:
    uint32_t maxMeshes_, meshLights_;
    std::vector<uint32_t> order_;
    std::vector<gpu::RsLightMesh> list_;
};

}   // namespace restir
