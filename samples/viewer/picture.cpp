#include "viewer/picture.h"

#include <algorithm>
#include <array>
#include <chrono>

#include "common/setting_options.h"

namespace viewer {
namespace {

constexpr uint32_t kRoom =
    64;   // pixels to which a session's extent is rounded up: growing by a few needs no new one

uint32_t roundUp(uint32_t side) { return (side + kRoom - 1) / kRoom * kRoom; }

samples::GpuImage makeImage(const samples::Device& device, VkExtent2D extent) {
    return samples::GpuImage(
        device, extent, VK_FORMAT_R32G32B32A32_SFLOAT,
        VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT);
}

}   // namespace

Picture::Images::Images(const samples::Device& device, const samples::GpuScene& scene, VkExtent2D extent)
    : radiance(makeImage(device, extent)),
      debug(makeImage(device, extent)),
      paths(makeImage(device, extent)),
      gbuffer(device, scene, extent),
      reference(device, scene, paths.view()),
      display(std::make_unique<Display>(device, scene, extent,
                                        Display::Inputs{radiance.view(), debug.view(), paths.view()})) {
    if (!scene.skyMap().rgb.empty())
        background =
            std::make_unique<samples::BackgroundPass>(device, scene, gbuffer, radiance.view(), extent);
    device.submitAndWait([&](VkCommandBuffer cmd) {
        const samples::Access clear{VK_PIPELINE_STAGE_2_CLEAR_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                                    VK_IMAGE_LAYOUT_GENERAL};
        samples::pipelineBarrier(cmd, std::array{samples::imageBarrier(radiance, {}, clear),
                                                 samples::imageBarrier(debug, {}, clear),
                                                 samples::imageBarrier(paths, {}, clear)});
        const VkClearColorValue black{};
        const VkImageSubresourceRange all{VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
        for (const samples::GpuImage* image : {&radiance, &debug, &paths})
            vkCmdClearColorImage(cmd, image->handle(), clear.layout, &black, 1, &all);
    });
}

Picture::Picture(samples::Device& device, Stage& stage) : device_(device), stage_(stage), clock_(device) {}

Picture::Fitted Picture::fit(VkExtent2D extent, const restir::Settings& settings) {
    restir::SessionDesc needed = declared_;
    samples::declareFor(settings, needed);
    needed.maxExtent = {std::max(declared_.maxExtent.width, roundUp(extent.width)),
                        std::max(declared_.maxExtent.height, roundUp(extent.height))};
    const bool grows = !session_ || needed.maxExtent.width > declared_.maxExtent.width ||
                       needed.maxExtent.height > declared_.maxExtent.height ||
                       needed.pairedNeighbours > declared_.pairedNeighbours ||
                       needed.indirect != declared_.indirect;
    const bool changes = !images_ || extent.width != extent_.width || extent.height != extent_.height;
    if (grows || changes) device_.waitIdle();
    if (grows) {
        session_.reset();   // before the next one: memory for both is never needed
        session_ = stage_.lighting->makeSession(needed);
        declared_ = needed;
    }
    if (changes) {
        images_.reset();
        images_ = std::make_unique<Images>(device_, *stage_.scene, extent);
        extent_ = extent;
    }
    return {.waited = grows || changes, .cleared = changes};
}

void Picture::moveScene(VkCommandBuffer cmd, const Shot& shot) {
    // A scene that stands still for a second frame is as the GPU has it.
    const bool rests = shot.frame.time == shot.frame.previousTime;
    if (!rests || !resting_)
        stage_.scene->record(cmd, shot.frame.slot, shot.motion, shot.frame.time, shot.frame.previousTime);
    resting_ = rests;
    stage_.lighting->record(cmd, shot.frame.slot);
}

restir::Status Picture::record(VkCommandBuffer cmd, const Shot& shot) {
    const samples::Frame& frame = shot.frame;
    const restir::RayBackend rays = stage_.lighting->rays();
    const restir::Scope in = restir::Session::inputScope(rays), out = restir::Session::outputScope(rays);
    clock_.begin(cmd, frame.slot);
    moveScene(cmd, shot);
    clock_.mark(cmd, "host.scene");
    images_->gbuffer.record(cmd, frame.pose, frame.previous, frame.jitter, in);
    clock_.mark(cmd, "host.gbuffer");
    // Last frame's readers of the outputs are done.
    samples::memoryBarrier(cmd, {VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_2_COPY_BIT, 0},
                           {out.stages, out.access});
    restir::FrameInput input = stage_.lighting->input(frame, images_->gbuffer);
    input.output.radiance = images_->radiance.view();
    const bool denoises = shot.denoise && shot.settings.debugView == restir::DebugView::None;
    if (denoises) {
        if (!images_->denoiser)
            images_->denoiser = std::make_unique<samples::Denoiser>(device_, *stage_.scene, images_->gbuffer,
                                                                    images_->radiance.view(), extent_);
        images_->denoiser->ask(input.output, shot.settings);
    }
    if (images_->denoiser && (input.resetHistory || !denoises)) images_->denoiser->reset();
    if (shot.settings.debugView != restir::DebugView::None) input.output.debug = images_->debug.view();
    const auto before = std::chrono::steady_clock::now();
    restir::Status status = session_->makePipelines(input, shot.settings);
    waited_ = std::chrono::steady_clock::now() - before > std::chrono::milliseconds(1);
    if (status == restir::Status::Ok) status = session_->record(cmd, input, shot.settings);
    clock_.mark(cmd, nullptr);
    if (status == restir::Status::Ok) {
        images_->gbuffer.share(cmd, in);
        if (denoises) {
            images_->denoiser->record(cmd, out, shot.settings, frame.pose, frame.previous);
            clock_.mark(cmd, "host.denoiser");
        }
        if (images_->background) {
            images_->background->record(cmd, out, frame.pose, frame.jitter);
            clock_.mark(cmd, "host.sky");
        }
    }
    if (shot.display.referenceFrames > 0) {
        samples::Frame paths = frame;
        paths.index = shot.display.referenceFrames;
        paths.seed = ~frame.seed;
        const bool indirect = shot.settings.gi.mode != restir::IndirectMode::Off;
        const samples::ReferenceSettings settings{.bounces = indirect ? shot.settings.gi.bounces : 1,
                                                  .direct = shot.settings.di.mode != restir::DirectMode::Off};
        images_->reference.record(cmd, extent_, paths, settings, false);
        clock_.mark(cmd, "host.reference");
    }
    samples::memoryBarrier(cmd, {out.stages, out.access},
                           {VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_READ_BIT});
    images_->display->record(cmd, frame.slot, shot.display);
    clock_.mark(cmd, "host.display");
    return status;
}

std::vector<restir::PassTiming> Picture::timings(uint32_t slot) {
    const auto library = session_->timings(slot);
    std::vector<restir::PassTiming> result(library.begin(), library.end());
    for (const restir::PassTiming& own : clock_.timings(slot)) result.push_back(own);
    return result;
}

std::vector<restir::BufferInfo> Picture::memory() const {
    const auto perView = session_->memory();
    std::vector<restir::BufferInfo> result(perView.begin(), perView.end());
    for (const restir::BufferInfo& buffer : stage_.lighting->memory()) result.push_back(buffer);
    return result;
}

}   // namespace viewer
