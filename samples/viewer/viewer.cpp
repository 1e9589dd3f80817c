#include "viewer/viewer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <stdexcept>

#include "viewer/input.h"
#include "viewer/panels.h"

namespace viewer {
namespace {

constexpr float kSoftwareScale = 0.25f;   // of pictures that the CPU renders
constexpr uint32_t kFewestPaths = 8;      // a pixel: from less a reference is no measure
constexpr float kExposureLag = 0.85f;     // share of the exposure that a frame keeps, in stops

samples::DeviceDesc deviceOf(const Options& options, const Window& window) {
    return {.validate = options.validate,
            .instanceExtensions = window.instanceExtensions(),
            .makeSurface = [&](VkInstance instance) { return window.makeSurface(instance); }};
}

bool samePose(const samples::CameraPose& a, const samples::CameraPose& b) {
    return a.eye == b.eye && a.right == b.right && a.up == b.up && a.forward == b.forward;
}

VkExtent2D scaled(VkExtent2D extent, float scale) {
    const auto side = [&](uint32_t pixels) {
        return std::max(static_cast<uint32_t>(std::lround(scale * static_cast<float>(pixels))), 1u);
    };
    return {side(extent.width), side(extent.height)};
}

}   // namespace

Viewer::Viewer(const Options& options)
    : options_(options),
      window_(options.window, "restir-viewer"),
      device_(deviceOf(options, window_)),
      swapchain_(device_),
      overlay_(device_, window_, swapchain_),
      slots_(device_) {
    const bool software = device_.properties().deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU;
    state_.rays = options.rays.value_or(device_.bestRays());
    state_.settings = options.settings;
    state_.scale = options.scale.value_or(software ? kSoftwareScale : 1.0f);
    if (!options.script.empty()) script_.emplace(options.script);
    if (!options.bridge.empty()) shaders_.emplace(options.bridge, state_.rays);
    resizeWindow();
    load(options.scene.scene);
}

Viewer::~Viewer() { device_.waitIdle(); }

void Viewer::resizeWindow() {
    device_.waitIdle();
    swapchain_.resize(window_.extent());
    overlay_.resize();
    interrupted_ = true;
}

void Viewer::load(const std::string& name) {
    window_.setTitle("restir-viewer: loading " + name);
    samples::SceneOptions options = options_.scene;
    if (name != options.scene) {   // the command line's views are of its scene
        options.scene = name;
        options.camera.reset();
        options.eye.clear();
        options.target.clear();
    }
    device_.waitIdle();
    auto stage = std::make_unique<Stage>(makeStage(device_, options, lightingDesc()));
    picture_.reset();   // before the stage that it borrows
    stage_ = std::move(stage);
    picture_ = std::make_unique<Picture>(device_, *stage_);
    state_.lookThrough(stage_->views.front());
    state_.animation = 0;
    state_.playing = false;
    state_.time = recordedTime_ = 0;
    referenceFrames_ = 0;
    history_.forgetErrors();
    interrupted_ = true;
    window_.setTitle("restir-viewer: " + name);
    for (const std::string& warning : stage_->warnings)
        std::fprintf(stderr, "warning: %s\n", warning.c_str());
}

samples::LightingDesc Viewer::lightingDesc() const {
    return {.rays = state_.rays, .shaders = shaders_ ? &shaders_->pack() : nullptr};
}

// Between two frames. What was there stays where this fails.
void Viewer::pollShaders() try {
    if (!shaders_->poll()) return;
    replaceLighting();
    std::fprintf(stderr, "restir-viewer: the passes were compiled again\n");
    ++state_.compilations;
} catch (const std::runtime_error& error) {
    state_.message = error.what();
    std::fprintf(stderr, "%s\n", error.what());
    ++state_.compilations;
}

// Likewise.
void Viewer::switchRays() {
    if (shaders_) shaders_->traceBy(state_.rays, [this] { replaceLighting(); });
    else replaceLighting();
}

void Viewer::replaceLighting() {
    device_.waitIdle();
    auto lighting = std::make_unique<samples::Lighting>(device_, *stage_->scene, lightingDesc());
    picture_.reset();   // before the Context that its session is of
    stage_->lighting = std::move(lighting);
    picture_ = std::make_unique<Picture>(device_, *stage_);
    state_.cut = true;
    state_.message.clear();
    referenceFrames_ = 0;
    history_.forgetErrors();
    interrupted_ = true;
}

void Viewer::replaceStage(const std::string& name) {
    loading_ = name;
    drawFrame();   // which says so, and stays until the scene is there
    loading_.clear();
    load(name);
}

// A user is told so; a script comes to an end.
void Viewer::refuse(const std::string& what) {
    if (script_) throw std::runtime_error(what);
    state_.message = what;
}

void Viewer::prepare() {
    if (shaders_) pollShaders();
    for (const std::string& path : window_.takeDropped()) state_.load = path;
    const std::string name = std::exchange(state_.load, {});
    const auto pictures = std::exchange(state_.savePictures, {});
    try {
        for (const std::string& path : pictures) savePicture(device_, *picture_, path);
        if (!device_.has(state_.rays)) {
            std::fprintf(stderr, "the device has none of what rays by %s need\n", samples::rayBackend(state_.rays).name);
            state_.rays = stage_->lighting->rays();
        }
        if (state_.rays != stage_->lighting->rays()) switchRays();
        if (!name.empty()) replaceStage(name);
        if (!name.empty() || !pictures.empty()) state_.message.clear();
    } catch (const std::runtime_error& error) {
        state_.rays = stage_->lighting->rays();
        refuse(error.what());
    }
    interrupted_ = interrupted_ || !pictures.empty();
    if (state_.windowSize) window_.resize(*std::exchange(state_.windowSize, {}));
    const VkExtent2D now = window_.extent();
    if (now.width != swapchain_.extent().width || now.height != swapchain_.extent().height) resizeWindow();
}

bool Viewer::finished() {
    if (state_.quit) return true;
    if (!script_ || script_->step(state_, *stage_)) return false;
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start_;
    return passed.count() >= options_.seconds;
}

void Viewer::run() {
    while (window_.poll() && !finished()) {
        prepare();
        drawFrame();
    }
    device_.waitIdle();
    for (std::optional<WindowShot>& shot : windowShots_)
        if (shot) std::exchange(shot, {})->write();
    for (const std::string& path : std::exchange(state_.savePictures, {}))
        savePicture(device_, *picture_, path);
}

void Viewer::collect(uint32_t slot) {
    if (const std::optional<Findings> findings = picture_->display().collect(slot)) {
        // Without direct light the reference has no lights in view, and the library does.
        const bool comparable =
            state_.settings.di.mode != restir::DirectMode::Off && referenceFrames_ >= kFewestPaths;
        if (findings->error && comparable) history_.addError(*findings->error);
        if (state_.autoExposure) {
            const float wanted = samples::autoExposure(findings->thumbnail);
            state_.exposure =
                state_.adapted ? wanted * std::pow(state_.exposure / wanted, kExposureLag) : wanted;
            state_.adapted = true;
        }
        history_.addTimings(picture_->timings(slot));
        counters_ = picture_->counters(slot);
    }
    if (windowShots_[slot]) std::exchange(windowShots_[slot], {})->write();
}

void Viewer::drawFrame() {
    const uint32_t slot = frame_ % samples::FrameSlots::kCount;
    slots_.wait(slot);
    const Picture::Fitted fitted = picture_->fit(scaled(swapchain_.extent(), state_.scale), state_.settings);
    if (fitted.cleared) referenceFrames_ = 0;
    interrupted_ = interrupted_ || fitted.waited;
    collect(slot);

    overlay_.begin();
    applyInput(state_, *stage_, window_);
    drawPanels(state_, {.device = device_,
                        .stage = *stage_,
                        .history = history_,
                        .extent = picture_->extent(),
                        .memory = picture_->memory(),
                        .counters = counters_,
                        .referenceFrames = referenceFrames_,
                        .loading = loading_});
    const std::optional<uint32_t> image = swapchain_.acquire(slot);
    if (!image) {
        overlay_.drop();
        resizeWindow();
        return;
    }
    const VkCommandBuffer cmd = slots_.begin(slot);
    record(cmd, slot, *image);
    const samples::WindowSync sync = swapchain_.sync(slot, *image);
    slots_.submit(slot, &sync);
    if (!swapchain_.present(*image)) resizeWindow();
    history_.endFrame(std::exchange(interrupted_, false));
    ++frame_;
}

Shot Viewer::describe(uint32_t slot) {
    const VkExtent2D extent = picture_->extent();
    if (state_.playing) state_.time += state_.pace;
    Shot shot;
    samples::Frame& frame = shot.frame;
    frame.index = frame_;
    frame.slot = slot;
    frame.cut = std::exchange(state_.cut, false);
    frame.time = state_.time;
    frame.previousTime = frame.cut ? state_.time : recordedTime_;
    frame.pose = makePose(state_.camera.view(), extent);
    frame.previous = frame.cut ? frame.pose : pose_;
    shot.motion = stage_->animations[state_.animation].motion;
    shot.settings = state_.settings;
    shot.settings.counters = true;

    const bool moved = frame.cut || frame.time != recordedTime_ || !samePose(frame.pose, pose_);
    if (moved || !state_.tracesReference()) referenceFrames_ = 0;
    if (state_.tracesReference()) ++referenceFrames_;
    shot.display = {.exposure = state_.exposure,
                    .line = state_.split ? state_.line : 1.0f,
                    .debug = state_.settings.debugView != restir::DebugView::None,
                    .referenceFrames = referenceFrames_};
    shot.denoise = state_.denoise;
    recordedTime_ = frame.time;
    pose_ = frame.pose;
    return shot;
}

void Viewer::record(VkCommandBuffer cmd, uint32_t slot, uint32_t image) {
    const restir::Status status = picture_->record(cmd, describe(slot));
    interrupted_ = interrupted_ || picture_->waited();
    state_.refusal = status == restir::Status::Ok ? "" : device_.sdkError();
    if (script_ && !state_.refusal.empty()) throw std::runtime_error(state_.refusal);
    enlarge(cmd, swapchain_.image(image));
    overlay_.record(cmd, image);
    const std::string path = std::exchange(state_.saveWindow, {});
    if (path.empty()) return;
    try {
        windowShots_[slot].emplace(device_, swapchain_, path);
        windowShots_[slot]->record(cmd, swapchain_.image(image));
    } catch (const std::runtime_error& error) {
        refuse(error.what());
    }
}

void Viewer::enlarge(VkCommandBuffer cmd, VkImage target) const {
    const samples::Access acquired{VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, 0, VK_IMAGE_LAYOUT_UNDEFINED};
    const samples::Access blit{VK_PIPELINE_STAGE_2_BLIT_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                               VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL};
    samples::pipelineBarrier(cmd, {{samples::imageBarrier(target, acquired, blit)}});
    const samples::GpuImage& source = picture_->display().image();
    const auto corner = [](VkExtent2D extent) {
        return VkOffset3D{static_cast<int32_t>(extent.width), static_cast<int32_t>(extent.height), 1};
    };
    const VkImageSubresourceLayers layers{VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    const VkImageBlit region{.srcSubresource = layers,
                             .srcOffsets = {{0, 0, 0}, corner(source.extent())},
                             .dstSubresource = layers,
                             .dstOffsets = {{0, 0, 0}, corner(swapchain_.extent())}};
    vkCmdBlitImage(cmd, source.handle(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, target, blit.layout, 1,
                   &region, state_.smooth ? VK_FILTER_LINEAR : VK_FILTER_NEAREST);
}

}   // namespace viewer
