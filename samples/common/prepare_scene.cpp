#include "common/prepare_scene.h"

#include <algorithm>
#include <map>

#include "common/emission_texture.h"
#include "common/sort_triangles.h"

namespace samples {
namespace {

bool isEmitter(const SceneData& scene, const Geometry& geometry) {
    const auto& material = scene.materials[geometry.material];
    const bool oneSided = (material.flags & RS_MATERIAL_DOUBLE_SIDED) == 0;
    return oneSided && material.emission.x + material.emission.y + material.emission.z > 0;
}

void turnMirroredEmitters(SceneData& scene) {
    std::map<uint32_t, uint32_t> turned;   // mesh to its copy
    for (Instance& instance : scene.instances) {
        if (glm::determinant(glm::mat3(instance.worldFromObject)) >= 0) continue;
        const auto& geometries = scene.meshes[instance.mesh].geometries;
        const auto emits = [&](const Geometry& geometry) { return isEmitter(scene, geometry); };
        if (std::none_of(geometries.begin(), geometries.end(), emits)) continue;
        const auto [entry, added] =
            turned.try_emplace(instance.mesh, static_cast<uint32_t>(scene.meshes.size()));
        if (added) {
            Mesh copy = scene.meshes[instance.mesh];
            for (Geometry& geometry : copy.geometries) {
                for (size_t i = 0; i + 2 < geometry.indices.size(); i += 3) {
                    std::swap(geometry.indices[i + 1], geometry.indices[i + 2]);
                }
            }
            scene.meshes.push_back(std::move(copy));
        }
        instance.mesh = entry->second;
    }
}

void dropEmpty(SceneData& scene) {
    for (Mesh& mesh : scene.meshes) {
        std::erase_if(mesh.geometries, [](const Geometry& geometry) { return geometry.indices.size() < 3; });
    }
    std::erase_if(scene.instances,
                  [&](const Instance& instance) { return scene.meshes[instance.mesh].geometries.empty(); });
}

void dropUnused(SceneData& scene) {
    std::vector<uint32_t> renamed(scene.meshes.size(), UINT32_MAX);
    std::vector<Mesh> kept;
    for (Instance& instance : scene.instances) {
        uint32_t& name = renamed[instance.mesh];
        if (name == UINT32_MAX) {
            name = static_cast<uint32_t>(kept.size());
            kept.push_back(std::move(scene.meshes[instance.mesh]));
        }
        instance.mesh = name;
    }
    scene.meshes = std::move(kept);
}

}   // namespace

void prepareScene(SceneData& scene) {
    dropEmpty(scene);
    turnMirroredEmitters(scene);
    dropUnused(scene);
    for (Mesh& mesh : scene.meshes) {
        for (Geometry& geometry : mesh.geometries) sortTriangles(geometry.positions, geometry.indices);
    }
    bakeMaskedEmission(scene);
}

}   // namespace samples
