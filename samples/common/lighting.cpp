#include "common/lighting.h"

#include <algorithm>

namespace samples {
namespace {

restir::Context makeContext(Device& device, const GpuScene& scene, const LightingDesc& lighting) {
    restir::ContextDesc desc;
    desc.device = device.sdkInfo();
    desc.rays = lighting.rays.value_or(device.bestRays());
    desc.shaders = lighting.shaders;
    if (!lighting.shaders) desc.pipelines = restir::PipelineCreation::OnDemand;   // those are the caller's, and may go
    desc.framesInFlight = FrameSlots::kCount;
    desc.queueFamily = device.queueFamily();
    desc.maxTextures = std::max(static_cast<uint32_t>(scene.textures().size()), 1u);
    device.check(restir::checkDevice(desc.device, desc.rays), "restir::checkDevice");
    return device.require(restir::Context::create(desc), "restir::Context");
}

restir::Scene makeScene(const Device& device, const restir::Context& context, const GpuScene& scene) {
    const restir::SceneDesc desc{
        .instances = scene.instances(), .materials = scene.materials(), .textures = scene.textures()};
    return device.require(restir::Scene::create(context, desc), "restir::Scene");
}

restir::LightTableDesc lightsOf(const GpuScene& scene, Emitters emitters) {
    const FloatImage& sky = scene.skyMap();
    restir::LightTableDesc desc{.maxLights = scene.maxLights(), .maxEnvironmentTexels = sky.width * sky.height};
    if (emitters == Emitters::Meshes) {
        desc.meshLights = scene.meshLights();
        desc.maxMeshes = static_cast<uint32_t>(scene.lightMeshes().size());
    }
    return desc;
}

}   // namespace

Lighting::Lighting(Device& device, GpuScene& scene, const LightingDesc& desc)
    : device_(device),
      scene_(scene),
      rays_(desc.rays.value_or(device.bestRays())),
      lightsDesc_(lightsOf(scene, desc.emitters)),
      context_(makeContext(device, scene, desc)),
      sdkScene_(makeScene(device, context_, scene)),
      lights_(device.require(restir::LightTable::create(context_, lightsDesc_), "restir::LightTable")) {
    if (const FloatImage& sky = scene.skyMap(); !sky.rgb.empty())
        device.check(lights_.uploadEnvironment({sky.width, sky.height, sky.rgb}),
                     "restir::LightTable::uploadEnvironment");
    if (desc.emitters == Emitters::Meshes)
        device.check(lights_.uploadMeshes(0, scene.lightMeshes()), "restir::LightTable::uploadMeshes");
    if (rays_ == restir::RayBackend::Software) makeBvh();
    device.submitAndWait([&](VkCommandBuffer cmd) { upload(cmd, 0); });
    if (bvh_) bvh_->releaseStaging();
}

void Lighting::makeBvh() {
    const std::vector<restir::BvhMesh> meshes = scene_.makeBvhMeshes();
    const restir::BvhDesc desc{.meshes = meshes, .maxInstances = static_cast<uint32_t>(scene_.bvhInstances().size())};
    bvh_ = device_.require(restir::Bvh::create(context_, desc), "restir::Bvh");
    bvhBytes_ = restir::Bvh::memoryNeeded(context_, desc);
}

void Lighting::upload(VkCommandBuffer cmd, uint32_t slot) {
    device_.check(lights_.upload(slot, scene_.lights(lightsDesc_.meshLights)), "restir::LightTable::upload");
    device_.check(lights_.record(cmd, slot, &sdkScene_), "restir::LightTable::record");
    if (bvh_) device_.check(bvh_->record(cmd, slot, scene_.bvhInstances()), "restir::Bvh::record");
    version_ = scene_.version();
}

void Lighting::record(VkCommandBuffer cmd, uint32_t slot) {
    if (version_ != scene_.version()) upload(cmd, slot);
}

restir::FrameInput Lighting::input(const Frame& frame, const GBufferPass& gbuffer) const {
    restir::FrameInput input;
    input.frameSlot = frame.slot;
    input.frameIndex = frame.index;
    input.seed = frame.seed;
    input.extent = gbuffer.extent();
    input.camera = sdkCamera(frame.pose, frame.jitter);
    input.gbuffer = gbuffer.describe();
    input.tlas = scene_.tlas();
    input.previousTlas = scene_.previousTlas();
    input.bvh = bvh_ ? &*bvh_ : nullptr;
    input.scene = &sdkScene_;
    input.lights = &lights_;
    input.resetHistory = frame.cut;
    return input;
}

restir::Session Lighting::makeSession(const restir::SessionDesc& desc) const {
    return device_.require(restir::Session::create(context_, desc), "restir::Session");
}

std::vector<restir::BufferInfo> Lighting::memory() const {
    std::vector<restir::BufferInfo> result = {
        {.name = "light table", .bytes = restir::LightTable::memoryNeeded(context_, lightsDesc_)}};
    if (bvh_) result.push_back({.name = "BVH, staging included", .bytes = bvhBytes_});
    return result;
}

}   // namespace samples
