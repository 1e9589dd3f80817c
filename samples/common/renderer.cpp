#include "common/renderer.h"

#include <algorithm>

namespace samples {
namespace {

restir::Context makeContext(Device& device, const GpuScene& scene) {
    restir::ContextDesc desc;
    desc.device = device.sdkInfo();
    desc.framesInFlight = FrameSlots::kCount;
    desc.queueFamily = device.queueFamily();
    desc.maxTextures = std::max(static_cast<uint32_t>(scene.textures().size()), 1u);
    return device.require(restir::Context::create(desc), "restir::Context");
}

restir::Scene makeScene(const Device& device, const restir::Context& context, const GpuScene& scene) {
    const restir::SceneDesc desc{
        .instances = scene.instances(), .materials = scene.materials(), .textures = scene.textures()};
    return device.require(restir::Scene::create(context, desc), "restir::Scene");
}

restir::LightTableDesc lightsOf(const GpuScene& scene) {
    const FloatImage& sky = scene.skyMap();
    return {.maxLights = scene.maxLights(), .maxEnvironmentTexels = sky.width * sky.height};
}

restir::SessionDesc withExtent(restir::SessionDesc desc, VkExtent2D extent) {
    desc.maxExtent = extent;
    return desc;
}

}   // namespace

Renderer::Renderer(Device& device, GpuScene& scene, VkExtent2D extent, restir::SessionDesc session)
    : device_(device),
      scene_(scene),
      loop_(device, extent),
      gbuffer_(device, scene, extent),
      context_(makeContext(device, scene)),
      sdkScene_(makeScene(device, context_, scene)),
      lights_(device.require(restir::LightTable::create(context_, lightsOf(scene)), "restir::LightTable")),
      session_(
          device.require(restir::Session::create(context_, withExtent(session, extent)), "restir::Session")),
      lightBytes_(restir::LightTable::memoryNeeded(context_, lightsOf(scene))) {
    if (const FloatImage& sky = scene.skyMap(); !sky.rgb.empty()) {
        device.check(lights_.uploadEnvironment({sky.width, sky.height, sky.rgb}), "restir::LightTable::uploadEnvironment");
        background_ = std::make_unique<BackgroundPass>(device, scene, gbuffer_, loop_.target(), extent);
    }
    device.submitAndWait([&](VkCommandBuffer cmd) { uploadLights(cmd, 0); });
}

void Renderer::uploadLights(VkCommandBuffer cmd, uint32_t slot) {
    device_.check(lights_.upload(slot, scene_.lights()), "restir::LightTable::upload");
    device_.check(lights_.record(cmd, slot), "restir::LightTable::record");
    lightVersion_ = scene_.version();
}

FloatImage Renderer::render(const Sequence& sequence, const restir::Settings& settings,
                            const std::function<void(uint32_t, uint32_t)>& progress) {
    stats_ = {};
    FrameCallbacks callbacks;
    settings_ = settings;
    alpha_.clear();
    if (debugs() && unseen_.handle() == VK_NULL_HANDLE)
        unseen_ = GpuImage(device_, loop_.extent(), VK_FORMAT_R32G32B32A32_SFLOAT, VK_IMAGE_USAGE_STORAGE_BIT);
    callbacks.record = [&](VkCommandBuffer cmd, const Frame& frame) { record(cmd, sequence, frame); };
    callbacks.finished = [&](const Frame& frame, std::span<const float> target) { collect(frame, target); };
    callbacks.progress = progress;
    callbacks.written = restir::Session::outputScope();
    FloatImage image = loop_.run(sequence, callbacks);
    image.alpha = std::move(alpha_);
    return image;
}

void Renderer::record(VkCommandBuffer cmd, const Sequence& sequence, const Frame& frame) {
    scene_.record(cmd, frame.slot, sequence.motion, frame.time, frame.previousTime);
    if (lightVersion_ != scene_.version()) uploadLights(cmd, frame.slot);
    gbuffer_.record(cmd, frame.pose, frame.previous, frame.jitter, restir::Session::inputScope());
    restir::Settings settings = settings_;
    settings.counters = settings.counters || frame.last;
    restir::FrameInput input;
    input.frameSlot = frame.slot;
    input.frameIndex = frame.index;
    input.seed = frame.seed;
    input.extent = loop_.extent();
    input.camera = sdkCamera(frame.pose, frame.jitter);
    input.gbuffer = gbuffer_.describe();
    input.tlas = scene_.tlas();
    if (sequence.previousTlas) input.previousTlas = scene_.previousTlas();
    input.scene = &sdkScene_;
    input.lights = &lights_;
    input.output.radiance = loop_.target();
    if (debugs()) {
        const restir::Scope scope = restir::Session::outputScope();
        const Access written{scope.stages, scope.access, VK_IMAGE_LAYOUT_GENERAL};
        pipelineBarrier(cmd, {{imageBarrier(unseen_, {scope.stages, scope.access, VK_IMAGE_LAYOUT_UNDEFINED}, written)}});
        input.output.radiance = unseen_.view();
        input.output.debug = loop_.target();
    }
    input.resetHistory = frame.index == 0;
    device_.check(session_.record(cmd, input, settings), "restir::Session::record");
    if (background_ && !debugs()) background_->record(cmd, frame.pose, frame.jitter);
}

void Renderer::collect(const Frame& frame, std::span<const float> target) {
    // A pass that the first frames do without still gets its place in the order.
    auto next = stats_.passes.begin();
    for (const restir::PassTiming& timing : session_.timings(frame.slot)) {
        const auto same = [&](const PassStats& pass) { return pass.name == timing.name; };
        auto pass = std::find_if(stats_.passes.begin(), stats_.passes.end(), same);
        if (pass == stats_.passes.end()) {
            pass = stats_.passes.insert(next, {timing.name, frame.index, {}});
        }
        const size_t at = frame.index - pass->firstFrame;
        pass->milliseconds.resize(at + 1);
        pass->milliseconds[at] += timing.milliseconds;
        next = pass + 1;
    }
    if (!frame.last) return;
    stats_.counters = session_.counters(frame.slot);
    for (size_t i = 3; debugs() && i < target.size(); i += 4) alpha_.push_back(target[i]);
}

std::vector<restir::BufferInfo> Renderer::memory() const {
    const auto perView = session_.memory();
    std::vector<restir::BufferInfo> result(perView.begin(), perView.end());
    result.push_back({.name = "light table", .bytes = lightBytes_});
    return result;
}

}   // namespace samples
