#include "common/gpu_scene.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "common/prepare_scene.h"
#include "common/sky.h"
#include "common/sort_triangles.h"

namespace samples {
namespace {

using restir::gpu::RsInstance;
using restir::gpu::RsMaterial;

constexpr uint32_t kMostRecords = 1u << 24;   // instanceCustomIndex has 24 bits
constexpr uint32_t kWrapModes = 3;
constexpr VkSamplerAddressMode kAddressModes[kWrapModes] = {VK_SAMPLER_ADDRESS_MODE_REPEAT,
                                                            VK_SAMPLER_ADDRESS_MODE_MIRRORED_REPEAT,
                                                            VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE};

template <class T>
std::span<const std::byte> bytesOf(const std::vector<T>& values) {
    return std::as_bytes(std::span(values));
}

glm::vec4 boxCentre(const Mesh& mesh) {
    glm::vec3 low(1e30f), high(-1e30f);
    for (const Geometry& geometry : mesh.geometries) {
        for (const glm::vec3& p : geometry.positions) {
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
    }
    return {0.5f * (low + high), 1.0f};
}

// Lavapipe halves the list of instances unsorted, like triangles.
std::vector<uint32_t> instanceOrder(const SceneData& scene) {
    std::vector<glm::vec4> centres;
    for (const Mesh& mesh : scene.meshes) centres.push_back(boxCentre(mesh));
    std::vector<glm::vec3> centroids;
    for (const Instance& instance : scene.instances) {
        centroids.emplace_back(instance.worldFromObject * centres[instance.mesh]);
    }
    return spatialOrder(centroids);
}

void checkLimits(const SceneData& scene) {
    uint64_t records = 0;
    for (const Instance& instance : scene.instances) records += scene.meshes[instance.mesh].geometries.size();
    if (records == 0) throw std::runtime_error("the scene has no triangles");
    if (records > kMostRecords) {
        throw std::runtime_error("the scene has " + std::to_string(records) +
                                 " instanced geometries; 2^24 is the most instanceCustomIndex can name");
    }
}

}   // namespace

GpuScene::GpuScene(const Device& device, SceneData scene) : device_(device) {
    prepareScene(scene);
    checkLimits(scene);
    rest_.lights = makeSceneLights(scene);
    rest_.materials = scene.materials;
    rest_.state = restOf(scene);
    state_ = rest_.state;
    try {
        Uploader uploader(device);
        uploadGeometry(uploader, scene);
        uploadTextures(uploader, scene);
        uploadInstances(uploader, scene);
        materials_ = makeStorage(uploader, scene.materials);
        referenceLights_ = makeStorage(uploader, rest_.lights.reference);
        sky_ = makeStorage(uploader, skyTable(scene.sky, static_cast<uint32_t>(scene.textures.size())));
        skyMap_ = std::move(scene.sky.map);
        uploader.flush();
        buildAcceleration(scene);
        keepGeometry(scene);
        makeSet();
    } catch (...) {
        release();
        throw;
    }
}

GpuScene::~GpuScene() { release(); }

void GpuScene::release() {
    for (VkSampler made : samplers_) vkDestroySampler(device_.handle(), made, nullptr);
    vkDestroyDescriptorPool(device_.handle(), pool_, nullptr);
    vkDestroyDescriptorSetLayout(device_.handle(), setLayout_, nullptr);
}

template <class T>
Buffer GpuScene::makeStorage(Uploader& uploader, const std::vector<T>& values) const {
    Buffer buffer(device_, {.size = values.size() * sizeof(T),
                            .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT});
    uploader.buffer(buffer, 0, bytesOf(values));
    return buffer;
}

// All vertex data in one buffer, reached by address only.
void GpuScene::uploadGeometry(Uploader& uploader, const SceneData& scene) {
    VkDeviceSize size = 0;
    for (const Mesh& mesh : scene.meshes) {
        for (const Geometry& geometry : mesh.geometries) {
            size += bytesOf(geometry.positions).size() + bytesOf(geometry.indices).size() +
                    bytesOf(geometry.normals).size() + bytesOf(geometry.uvs).size();
        }
    }
    geometry_ =
        Buffer(device_, {.size = size,
                         .usage = VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT |
                                  VK_BUFFER_USAGE_TRANSFER_DST_BIT | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
                                  VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_BUILD_INPUT_READ_ONLY_BIT_KHR});
    VkDeviceSize offset = 0;
    const auto append = [&](std::span<const std::byte> bytes) {
        const VkDeviceAddress address = bytes.empty() ? 0 : geometry_.address() + offset;
        uploader.buffer(geometry_, offset, bytes);
        offset += bytes.size();
        return address;
    };
    for (const Mesh& mesh : scene.meshes) {
        auto& addresses = addresses_.emplace_back();
        for (const Geometry& geometry : mesh.geometries) {
            addresses.push_back({.positions = append(bytesOf(geometry.positions)),
                                 .indices = append(bytesOf(geometry.indices)),
                                 .normals = append(bytesOf(geometry.normals)),
                                 .uvs = append(bytesOf(geometry.uvs))});
        }
    }
}

VkSampler GpuScene::sampler(const Texture& texture) {
    const auto u = static_cast<size_t>(texture.wrapU), v = static_cast<size_t>(texture.wrapV);
    VkSampler& made = samplers_[(u * kWrapModes + v) * 2 + (texture.nearest ? 1 : 0)];
    if (made != VK_NULL_HANDLE) return made;
    const VkFilter filter = texture.nearest ? VK_FILTER_NEAREST : VK_FILTER_LINEAR;
    const VkSamplerCreateInfo info{.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO,
                                   .magFilter = filter,
                                   .minFilter = filter,
                                   .addressModeU = kAddressModes[u],
                                   .addressModeV = kAddressModes[v],
                                   .addressModeW = VK_SAMPLER_ADDRESS_MODE_REPEAT};
    check(vkCreateSampler(device_.handle(), &info, nullptr, &made), "vkCreateSampler");
    return made;
}

void GpuScene::uploadTextures(Uploader& uploader, const SceneData& scene) {
    for (const Image& image : scene.images) {
        const VkFormat format = image.srgb ? VK_FORMAT_R8G8B8A8_SRGB : VK_FORMAT_R8G8B8A8_UNORM;
        images_.emplace_back(device_, VkExtent2D{image.width, image.height}, format,
                             VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT);
        uploader.image(images_.back(), bytesOf(image.rgba));
    }
    samplers_.resize(size_t{kWrapModes} * kWrapModes * 2);
    for (const Texture& texture : scene.textures) {
        textureInfos_.push_back({.sampler = sampler(texture),
                                 .imageView = images_[texture.image].view(),
                                 .imageLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL});
    }
    if (!scene.sky.map.rgb.empty()) uploadSky(uploader, scene.sky.map);
}

void GpuScene::uploadSky(Uploader& uploader, const FloatImage& map) {
    std::vector<float> rgba;
    for (size_t i = 0; i < map.rgb.size(); i += 3)
        rgba.insert(rgba.end(), {map.rgb[i], map.rgb[i + 1], map.rgb[i + 2], 1.0f});
    images_.emplace_back(device_, VkExtent2D{map.width, map.height}, VK_FORMAT_R32G32B32A32_SFLOAT,
                         VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT);
    uploader.image(images_.back(), bytesOf(rgba));
    textureInfos_.push_back({.sampler = sampler({.wrapU = Wrap::Repeat, .wrapV = Wrap::Clamp}),
                             .imageView = images_.back().view(),
                             .imageLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL});
}

void GpuScene::uploadInstances(Uploader& uploader, const SceneData& scene) {
    std::vector<Rows> transforms;
    for (uint32_t instance = 0; instance < scene.instances.size(); ++instance) {
        const auto& [mesh, worldFromObject] = scene.instances[instance];
        const auto& geometries = scene.meshes[mesh].geometries;
        for (size_t i = 0; i < geometries.size(); ++i) {
            const GeometryAddresses& addresses = addresses_[mesh][i];
            RsInstance record{.positions = addresses.positions,
                              .indices = addresses.indices,
                              .normals = addresses.normals,
                              .uvs = addresses.uvs,
                              .worldFromObject = {},
                              .material = geometries[i].material,
                              .firstLight = rest_.lights.firstLight[rest_.records.size()]};
            copyRows(record.worldFromObject, worldFromObject);
            rest_.records.push_back(record);
            rest_.instanceOf.push_back(instance);
            transforms.push_back(rowsOf(worldFromObject));
            triangleCount_ += geometries[i].indices.size() / 3;
        }
    }
    instances_ = makeStorage(uploader, rest_.records);
    previousTransforms_ = makeStorage(uploader, transforms);
}

void GpuScene::buildAcceleration(const SceneData& scene) {
    std::vector<std::vector<TriangleRange>> meshes;
    for (size_t mesh = 0; mesh < scene.meshes.size(); ++mesh) {
        auto& ranges = meshes.emplace_back();
        for (size_t i = 0; i < scene.meshes[mesh].geometries.size(); ++i) {
            const Geometry& geometry = scene.meshes[mesh].geometries[i];
            const uint32_t flags = scene.materials[geometry.material].flags;
            ranges.push_back({.positions = addresses_[mesh][i].positions,
                              .indices = addresses_[mesh][i].indices,
                              .vertexCount = static_cast<uint32_t>(geometry.positions.size()),
                              .triangleCount = static_cast<uint32_t>(geometry.indices.size() / 3),
                              .opaque = (flags & RS_MATERIAL_ALPHA_MASK) == 0});
        }
    }
    std::vector<VkAccelerationStructureInstanceKHR> instances;
    uint32_t record = 0;
    for (const Instance& instance : scene.instances) {
        VkAccelerationStructureInstanceKHR entry{};
        entry.instanceShaderBindingTableRecordOffset = 3;   // as of a host with hit shaders of its own: nobody minds
        copyRows(entry.transform.matrix, instance.worldFromObject);
        entry.instanceCustomIndex = record & 0xffffffu;
        entry.mask = 0xff;
        entry.flags = VK_GEOMETRY_INSTANCE_TRIANGLE_FACING_CULL_DISABLE_BIT_KHR;
        entry.accelerationStructureReference = instance.mesh;
        instances.push_back(entry);
        bvhInstances_.push_back({.mesh = instance.mesh, .record = record});
        record += static_cast<uint32_t>(scene.meshes[instance.mesh].geometries.size());
    }
    rest_.entryInstance = instanceOrder(scene);
    std::vector<VkAccelerationStructureInstanceKHR> entries;
    for (uint32_t i : rest_.entryInstance) entries.push_back(instances[i]);
    acceleration_ = Acceleration(device_, meshes, std::move(entries));
    rest_.entries = acceleration_.instances();
}

void GpuScene::keepGeometry(SceneData& scene) {
    for (Mesh& mesh : scene.meshes) {
        for (Geometry& geometry : mesh.geometries) {
            geometry.normals = {};
            geometry.uvs = {};
        }
    }
    meshes_ = std::move(scene.meshes);
    for (const RsMaterial& material : rest_.materials)
        alphaMasked_.push_back((material.flags & RS_MATERIAL_ALPHA_MASK) != 0);
}

std::vector<restir::BvhMesh> GpuScene::makeBvhMeshes() const {
    std::vector<restir::BvhMesh> result;
    for (const Mesh& mesh : meshes_) {
        std::vector<restir::BvhGeometry> geometries;
        for (const Geometry& geometry : mesh.geometries)
            geometries.push_back({.positions = {&geometry.positions.data()->x, 3 * geometry.positions.size()},
                                  .indices = geometry.indices,
                                  .opaque = !alphaMasked_[geometry.material]});
        auto made = restir::BvhMesh::create({.geometries = geometries});
        if (!made) throw std::runtime_error(std::string("restir::BvhMesh: ") + made.error().what);
        result.push_back(std::move(*made));
    }
    return result;
}

std::vector<restir::BvhInstance> GpuScene::bvhInstances() const {
    std::vector<restir::BvhInstance> result = bvhInstances_;
    for (size_t i = 0; i < result.size(); ++i) {
        const Rows rows = rowsOf(state_.worldFromObject[i]);
        static_assert(sizeof result[i].worldFromObject == sizeof rows);
        std::memcpy(result[i].worldFromObject, &rows, sizeof rows);
    }
    return result;
}

void GpuScene::startMoving() {
    otherTop_ = TopLevel(device_, static_cast<uint32_t>(rest_.entries.size()));
    writeSet(1);
    motion_ =
        std::make_unique<SceneMotion>(device_, rest_,
                                      SceneMotion::Targets{instances_.handle(), previousTransforms_.handle(),
                                                           materials_.handle(), referenceLights_.handle(),
                                                           sky_.handle()});
}

void GpuScene::record(VkCommandBuffer cmd, uint32_t slot, const Motion& motion, float time, float previous) {
    previousTlas_ = VK_NULL_HANDLE;
    if (!motion && !moved_) return;
    if (!motion_) startMoving();
    SceneState now = rest_.state, before = rest_.state;
    if (motion) {
        motion(time, now);
        motion(previous, before);
    }
    if (time != previous) previousTlas_ = tlas();
    current_ = 1 - current_;
    motion_->record(cmd, slot, now, before, top(current_));
    state_ = std::move(now);
    ++version_;
    moved_ = static_cast<bool>(motion);
}

}   // namespace samples
