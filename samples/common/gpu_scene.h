// A scene on the GPU, in the SDK's standard contract.
#pragma once

#include <vector>

#include "common/acceleration.h"
#include "common/gpu_memory.h"
#include "common/scene_lights.h"

namespace samples {

class GpuScene {
public:
    // Throws std::runtime_error when the scene is beyond a limit of the device or the SDK.
    GpuScene(const Device& device, SceneData scene);
    ~GpuScene();
    GpuScene(const GpuScene&) = delete;
    GpuScene& operator=(const GpuScene&) = delete;

    // For the SDK: SceneDesc, FrameInput::tlas, LightTable::upload().
    VkBuffer instances() const { return instances_.handle(); }
    VkBuffer materials() const { return materials_.handle(); }
    const std::vector<VkDescriptorImageInfo>& textures() const { return textureInfos_; }
    VkAccelerationStructureKHR tlas() const { return acceleration_.top(); }
    const std::vector<restir::Light>& lights() const { return lights_; }
    uint32_t maxLights() const { return maxLights_; }   // one more than the largest id

    // For the samples' own shaders: set 1 of scene.glsl.
    VkDescriptorSetLayout setLayout() const { return setLayout_; }
    VkDescriptorSet set() const { return set_; }

    uint64_t triangleCount() const { return triangleCount_; }   // instances counted
    uint64_t emissiveTriangleCount() const { return emissiveTriangleCount_; }

private:
    void release();
    void uploadGeometry(Uploader& uploader, const SceneData& scene);
    void uploadTextures(Uploader& uploader, const SceneData& scene);
    void uploadInstances(Uploader& uploader, const SceneData& scene, const SceneLights& lights);
    void buildAcceleration(const SceneData& scene);
    void makeSet();
    void writeSet() const;
    VkSampler sampler(const Texture& texture);
    template <class T>
    Buffer makeStorage(Uploader& uploader, const std::vector<T>& values) const;

    struct GeometryAddresses {
        VkDeviceAddress positions = 0, indices = 0, normals = 0, uvs = 0;
    };

    const Device& device_;
    Buffer geometry_, instances_, materials_, referenceLights_;
    std::vector<std::vector<GeometryAddresses>> addresses_;   // by mesh and geometry
    Acceleration acceleration_;
    std::vector<GpuImage> images_;
    std::vector<VkSampler> samplers_;   // by their settings; most are never made
    std::vector<VkDescriptorImageInfo> textureInfos_;
    std::vector<restir::Light> lights_;
    uint32_t maxLights_ = 0;
    uint64_t triangleCount_ = 0, emissiveTriangleCount_ = 0;
    VkDescriptorSetLayout setLayout_ = VK_NULL_HANDLE;
    VkDescriptorPool pool_ = VK_NULL_HANDLE;
    VkDescriptorSet set_ = VK_NULL_HANDLE;
};

}   // namespace samples
