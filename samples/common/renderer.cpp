#include "common/renderer.h"

#include <algorithm>

namespace samples {
namespace {

restir::SessionDesc withExtent(restir::SessionDesc desc, VkExtent2D extent) {
    desc.maxExtent = extent;
    return desc;
}

}   // namespace

Renderer::Renderer(Device& device, GpuScene& scene, VkExtent2D extent, restir::SessionDesc session,
                   const LightingDesc& lighting)
    : device_(device),
      scene_(scene),
      loop_(device, extent),
      gbuffer_(device, scene, extent),
      lighting_(device, scene, lighting),
      session_(lighting_.makeSession(withExtent(session, extent))) {
    if (!scene.skyMap().rgb.empty())
        background_ = std::make_unique<BackgroundPass>(device, scene, gbuffer_, loop_.target(), extent);
}

FloatImage Renderer::render(const Sequence& sequence, const restir::Settings& settings,
                            const std::function<void(uint32_t, uint32_t)>& progress) {
    stats_ = {};
    FrameCallbacks callbacks;
    settings_ = settings;
    alpha_.clear();
    if (debugs() && unseen_.handle() == VK_NULL_HANDLE)
        unseen_ =
            GpuImage(device_, loop_.extent(), VK_FORMAT_R32G32B32A32_SFLOAT, VK_IMAGE_USAGE_STORAGE_BIT);
    if (sequence.denoise && !denoiser_)
        denoiser_ = std::make_unique<Denoiser>(device_, scene_, gbuffer_, loop_.target(), loop_.extent());
    if (denoiser_) denoiser_->reset();
    callbacks.record = [&](VkCommandBuffer cmd, const Frame& frame) { record(cmd, sequence, frame); };
    callbacks.finished = [&](const Frame& frame, std::span<const float> target) { collect(frame, target); };
    callbacks.progress = progress;
    callbacks.written = restir::Session::outputScope(lighting_.rays());
    FloatImage image = loop_.run(sequence, callbacks);
    image.alpha = std::move(alpha_);
    return image;
}

void Renderer::record(VkCommandBuffer cmd, const Sequence& sequence, const Frame& frame) {
    scene_.record(cmd, frame.slot, sequence.motion, frame.time, frame.previousTime);
    lighting_.record(cmd, frame.slot);
    gbuffer_.record(cmd, frame.pose, frame.previous, frame.jitter, restir::Session::inputScope(lighting_.rays()));
    restir::Settings settings = settings_;
    settings.counters = settings.counters || frame.last;
    restir::FrameInput input = lighting_.input(frame, gbuffer_);
    if (!sequence.previousTlas) input.previousTlas = VK_NULL_HANDLE;
    input.output.radiance = loop_.target();
    if (sequence.denoise) denoiser_->ask(input.output, settings);
    const restir::Scope scope = restir::Session::outputScope(lighting_.rays());
    if (debugs()) {
        const Access written{scope.stages, scope.access, VK_IMAGE_LAYOUT_GENERAL};
        pipelineBarrier(
            cmd, {{imageBarrier(unseen_, {scope.stages, scope.access, VK_IMAGE_LAYOUT_UNDEFINED}, written)}});
        input.output.radiance = unseen_.view();
        input.output.debug = loop_.target();
    }
    device_.check(session_.record(cmd, input, settings), "restir::Session::record");
    if (debugs()) return;
    if (background_ || sequence.denoise) gbuffer_.share(cmd, restir::Session::inputScope(lighting_.rays()));
    if (sequence.denoise) denoiser_->record(cmd, scope, settings, frame.pose, frame.previous);
    if (background_) background_->record(cmd, scope, frame.pose, frame.jitter);
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
    for (const restir::BufferInfo& buffer : lighting_.memory()) result.push_back(buffer);
    return result;
}

}   // namespace samples
