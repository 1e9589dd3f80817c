// A host that shares nothing with restir's standard contract but the acceleration structure: a
// visibility buffer, materials of its own, and its own descriptor set 1. See bridge/restir_bridge.glsl.
#pragma once

#include <span>
#include <vector>

#include <restir/restir.h>

#include "common/camera.h"
#include "common/scene_pass.h"
#include "common/image_io.h"

namespace own_bridge {

// OwnPaint in restir_bridge.glsl.
struct Paint {
    glm::vec3 color{0.5f};
    float retro = 0;
    glm::vec3 emission{0};
    uint32_t twoSided = 0;   // shines to both sides
};

// By material of a scene: its base colour and emission, metals as retroreflective paints.
std::vector<Paint> paintsOf(const samples::SceneData& scene);

class Host {
public:
    enum Target : uint8_t { Radiance, Diffuse, Specular, TargetCount };

    // The scene outlives it. One frame is in flight at a time. `rays`: RayQuery or Pipeline.
    Host(samples::Device& device, const samples::GpuScene& scene, std::span<const Paint> paints,
         VkExtent2D extent, restir::RayBackend rays);   // RayQuery or Pipeline
    ~Host();
    Host(const Host&) = delete;
    Host& operator=(const Host&) = delete;

    // Renders and waits. `reset` forgets the frames before.
    void frame(const samples::View& view, uint64_t index, uint32_t seed, const restir::Settings& settings,
               bool reset = false);
    samples::FloatImage read(Target target) const;   // of the last frame

private:
    void makeSet(std::span<const Paint> paints);
    void makeSdkObjects();

    samples::Device& device_;
    const samples::GpuScene& scene_;
    VkExtent2D extent_;
    restir::RayBackend rays_;
    samples::Buffer visibility_, paints_;
    samples::ScenePass visibilityPass_;
    samples::GpuImage targets_[TargetCount];
    samples::Buffer readbacks_[TargetCount];
    VkDescriptorSetLayout setLayout_ = VK_NULL_HANDLE;
    VkDescriptorPool pool_ = VK_NULL_HANDLE;
    VkDescriptorSet set_ = VK_NULL_HANDLE;
    std::unique_ptr<restir::Context> context_;
    std::unique_ptr<restir::LightTable> lights_;
    std::unique_ptr<restir::Session> session_;
};

}   // namespace own_bridge
