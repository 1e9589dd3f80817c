// What LightTable's passes leave in its buffers.
#pragma once

#include <span>
#include <vector>

#include <restir/lights.h>
#include <restir/scene.h>
#include <restir/shared/lights.h>

namespace tests {

struct BuiltTable {
    std::vector<restir::gpu::RsPackedLight> lights;   // by id, as many as there are ids
    std::vector<restir::gpu::RsAliasEntry> alias;     // all columns that are drawn from
    std::vector<restir::gpu::uvec4> tree;             // restir/lights/tree.glsl
};

// Of a table for `maxLights`, or for as many as there are ids; `times` over again in one command buffer.
BuiltTable build(std::span<const restir::Light> lights, uint32_t maxLights = 0, uint32_t times = 1);

// A table whose lights, or those with the first ids, are triangles of a scene.
class MeshTable {
public:
    // `desc.maxLights` are read back. Borrows what `scene` has.
    MeshTable(const restir::SceneDesc& scene, const restir::LightTableDesc& desc);

    restir::LightTable& table() { return table_; }
    const restir::Scene& scene() const { return scene_; }
    // Another build, of whatever has been uploaded to slot 0.
    BuiltTable build();

private:
    restir::LightTableDesc desc_;
    restir::Scene scene_;
    restir::LightTable table_;
    uint32_t builds_ = 0;
};

}   // namespace tests
