// A scene on the GPU, in the SDK's standard contract.
#pragma once

#include <memory>
#include <vector>

#include <restir/bvh.h>

#include "common/scene_motion.h"

namespace samples {

class GpuScene {
public:
    // Throws std::runtime_error when the scene is beyond a limit of the device or the SDK.
    GpuScene(const Device& device, SceneData scene);
    ~GpuScene();
    GpuScene(const GpuScene&) = delete;
    GpuScene& operator=(const GpuScene&) = delete;

    // Records what makes the scene that of `time`, where `previous` was the last frame's; the same: there was
    // none. All frames are submitted in recording order on one queue, and the GPU is done with the slot's
    // last use. Records nothing while nothing moves.
    void record(VkCommandBuffer cmd, uint32_t slot, const Motion& motion, float time, float previous);

    // For the SDK: SceneDesc, FrameInput::tlas and previousTlas, LightTable. As of the last
    // record().
    VkBuffer instances() const { return instances_.handle(); }
    VkBuffer materials() const { return materials_.handle(); }
    const std::vector<VkDescriptorImageInfo>& textures() const { return textureInfos_; }
    VkAccelerationStructureKHR tlas() const { return top(current_).handle(); }
    VkAccelerationStructureKHR previousTlas() const { return previousTlas_; }   // null: nothing moved
    std::vector<restir::Light> lights(uint32_t firstId = 0) const { return lightsAt(rest_.lights, state_, firstId); }
    uint64_t version() const { return version_; }                 // of all lights
    uint32_t maxLights() const { return rest_.lights.idCount; }   // one more than the largest id
    const std::vector<restir::LightMesh>& lightMeshes() const { return rest_.lights.meshes; }
    uint32_t meshLights() const { return rest_.lights.meshLights; }   // their ids are below, all others not
    // For RayBackend::Software: trees over the meshes, made anew by each call, and their instances as of the last record().
    std::vector<restir::BvhMesh> makeBvhMeshes() const;
    std::vector<restir::BvhInstance> bvhInstances() const;
    const FloatImage& skyMap() const { return skyMap_; }          // no pixels: no sky

    // For the samples' own shaders: set 1 of scene.glsl.
    VkDescriptorSetLayout setLayout() const { return setLayout_; }
    VkDescriptorSet set() const { return sets_[current_]; }
    // Lights that the reference chooses from, black ones too.
    uint32_t referenceLightCount() const { return static_cast<uint32_t>(rest_.lights.reference.size()); }

    uint64_t triangleCount() const { return triangleCount_; }   // instances counted
    uint64_t emissiveTriangleCount() const { return rest_.lights.emissiveTriangles; }

private:
    void release();
    void uploadGeometry(Uploader& uploader, const SceneData& scene);
    void uploadTextures(Uploader& uploader, const SceneData& scene);
    void uploadSky(Uploader& uploader, const FloatImage& map);
    void uploadInstances(Uploader& uploader, const SceneData& scene);
    void buildAcceleration(const SceneData& scene);
    void keepGeometry(SceneData& scene);
    void makeSet();
    void writeSet(uint32_t index) const;
    void startMoving();
    const TopLevel& top(uint32_t index) const { return index == 0 ? acceleration_.topLevel() : otherTop_; }
    VkSampler sampler(const Texture& texture);
    template <class T>
    Buffer makeStorage(Uploader& uploader, const std::vector<T>& values) const;

    struct GeometryAddresses {
        VkDeviceAddress positions = 0, indices = 0, normals = 0, uvs = 0;
    };

    const Device& device_;
    Buffer geometry_, instances_, previousTransforms_, materials_, referenceLights_, sky_;
    FloatImage skyMap_;
    std::vector<std::vector<GeometryAddresses>> addresses_;   // by mesh and geometry
    Acceleration acceleration_;
    std::vector<GpuImage> images_;
    std::vector<VkSampler> samplers_;   // by their settings; most are never made
    std::vector<VkDescriptorImageInfo> textureInfos_;
    std::vector<Mesh> meshes_;   // positions and indices; normals and uvs are gone
    std::vector<restir::BvhInstance> bvhInstances_;   // at rest
    std::vector<bool> alphaMasked_;   // by material
    RestingScene rest_;
    SceneState state_;
    uint64_t version_ = 0;
    uint64_t triangleCount_ = 0;

    // Made by the first frame that moves. Two top levels and two sets that differ in them, used in turn.
    std::unique_ptr<SceneMotion> motion_;
    TopLevel otherTop_;
    uint32_t current_ = 0;
    bool moved_ = false;   // away from rest
    VkAccelerationStructureKHR previousTlas_ = VK_NULL_HANDLE;

    VkDescriptorSetLayout setLayout_ = VK_NULL_HANDLE;
    VkDescriptorPool pool_ = VK_NULL_HANDLE;
    VkDescriptorSet sets_[2] = {};
};

}   // namespace samples
