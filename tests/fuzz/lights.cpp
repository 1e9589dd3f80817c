// Uploads of lights, meshes and maps that no host would make. What is accepted must be finite once packed.
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <lights/pack.h>

#include "fuzz/null_host.h"
#include "fuzz/take.h"
#include "fuzz/target.h"

namespace fuzz {
namespace {

constexpr uint32_t kMostLights = 24, kMostMeshes = 8, kMostTexels = 64;

std::vector<restir::Light> takeLights(Take& take, uint32_t first) {
    std::vector<restir::Light> lights(take.below(kMostLights));
    for (size_t i = 0; i < lights.size(); ++i) {
        restir::Light& light = lights[i];
        light.id = first + uint32_t(i);
        light.kind = restir::LightKind(take.below(9));
        light.vertex1[0] = light.vertex2[1] = 1;
        if (light.kind == restir::LightKind::Environment) light.texture = 0;
        take.maybe(light.id, light.twoSided, light.position, light.vertex1, light.vertex2, light.direction,
                   light.radius, light.range, light.innerCone, light.outerCone, light.angularRadius,
                   light.rotation, light.emission, light.texture, light.uv, light.meanLuminance);
        if (take.value<uint8_t>() == 0xff) light.kind = restir::LightKind(take.value<uint8_t>());
    }
    return lights;
}

void expectFinite(const restir::gpu::RsPackedLight& p) {
    for (float v : {p.position.x, p.position.y, p.position.z, p.edge1.x, p.edge1.y, p.edge1.z, p.edge2.x,
                    p.edge2.y, p.edge2.z, p.emission.x, p.emission.y, p.emission.z, p.selection, p.uv0.x,
                    p.uv0.y, p.uv1.x, p.uv1.y, p.uv2.x, p.uv2.y})
        if (!std::isfinite(v)) std::abort();
    if (p.selection < 0) std::abort();
}

// The same checks and packing that an upload makes, into memory that can be looked at.
void packAlone(std::span<const restir::Light> lights, const restir::LightTableDesc& desc,
               double environment) {
    restir::LightPacker packer({.first = desc.meshLights,
                                .lights = desc.maxLights,
                                .textures = kTextures,
                                .environment = environment});
    std::vector<restir::gpu::RsPackedLight> packed(desc.maxLights - desc.meshLights);
    restir::PackedLights found;
    if (packer.pack({}, lights, packed.data(), found) != restir::Status::Ok) return;
    for (uint32_t id = desc.meshLights; id < found.count; ++id) expectFinite(packed[id - desc.meshLights]);
}

std::vector<restir::LightMesh> takeMeshes(Take& take) {
    std::vector<restir::LightMesh> meshes(take.below(kMostMeshes));
    uint32_t next = 0;
    for (restir::LightMesh& mesh : meshes) {
        mesh = {.record = 1, .firstLight = next, .triangles = 1 + take.below(4)};
        take.maybe(mesh.record, mesh.firstLight, mesh.triangles);
        next = mesh.firstLight + mesh.triangles;
    }
    return meshes;
}

void uploadMap(Take& take, restir::LightTable& table) {
    restir::EnvironmentMap map{.width = 1 + take.below(8), .height = 1 + take.below(8)};
    std::vector<float> rgb(size_t{3} * map.width * map.height, 1.0f);
    for (float& channel : rgb) take.maybe(channel);
    map.rgb = rgb;
    take.maybe(map.width, map.height);
    (void)table.uploadEnvironment(map);
}

void run(std::span<const uint8_t> bytes) {
    Take take(bytes);
    restir::LightTableDesc desc{
        .maxLights = 32, .meshLights = take.below(16), .maxMeshes = 4, .maxEnvironmentTexels = kMostTexels};
    take.maybe(desc.maxLights, desc.meshLights, desc.maxMeshes, desc.maxEnvironmentTexels, desc.tree);
    auto table = restir::LightTable::create(context(), desc);
    if (!table) return;
    const auto cmd = someHandle<VkCommandBuffer>();
    while (!take.empty()) {
        const uint32_t slot = take.below(kFrames);
        switch (take.below(4)) {
            case 0: {
                const std::vector<restir::Light> lights = takeLights(take, desc.meshLights);
                if (table->upload(slot, lights) == restir::Status::Ok) packAlone(lights, desc, 1e30);
                break;
            }
            case 1:
                (void)table->uploadMeshes(slot, takeMeshes(take));
                break;
            case 2:
                uploadMap(take, *table);
                break;
            default:
                (void)table->record(cmd, slot, take.flag() ? &scene() : nullptr);
                break;
        }
        if (table->buffers().count > desc.maxLights) std::abort();
    }
}

// A light of each kind, a map and meshes, recorded.
std::vector<Bytes> seeds() {
    static constexpr uint8_t kUpload = 0, kMeshes = 1, kMap = 2, kRecord = 3, kAsItIs = 0;
    const auto lightOf = [](Bytes& bytes, uint8_t kind) {
        bytes.push_back(kind);
        bytes.insert(bytes.end(), 17, kAsItIs);   // fields
    };
    Bytes all{4, kAsItIs, kAsItIs, kAsItIs, 0, kMap, 7, 3};
    all.insert(all.end(), 3 * 8 * 4 + 2, kAsItIs);
    all.insert(all.end(), {0, kUpload, 9});
    for (uint8_t kind = 0; kind < 9; ++kind) lightOf(all, kind);
    all.insert(all.end(), {0, kMeshes, 1, 2, kAsItIs, kAsItIs, kAsItIs, 0, kRecord, 1});
    return {all, Bytes(all.begin(), all.begin() + 8)};
}

}   // namespace

const Target kLights{"lights", run, seeds};

}   // namespace fuzz
