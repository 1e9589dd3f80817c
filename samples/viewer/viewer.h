// The viewer: a window, a stage, and what happens once a frame.
#pragma once

#include <memory>
#include <optional>

#include "viewer/facts.h"
#include "viewer/live_shaders.h"
#include "viewer/options.h"
#include "viewer/overlay.h"
#include "viewer/screenshot.h"
#include "viewer/script.h"
#include "viewer/state.h"

namespace viewer {

class Viewer {
public:
    explicit Viewer(const Options& options);
    ~Viewer();
    Viewer(const Viewer&) = delete;
    Viewer& operator=(const Viewer&) = delete;

    // Until the window is closed or the script has come to its end. Throws std::runtime_error for what a
    // script wants and cannot be had; for a user that is State::message.
    void run();

    const History& history() const { return history_; }
    uint32_t validationMessages() const { return device_.validationMessages(); }

private:
    void prepare();   // the wishes for this frame
    void load(const std::string& name);
    void replaceStage(const std::string& name);
    samples::LightingDesc lightingDesc() const;
    void pollShaders();
    void switchRays();
    void replaceLighting();
    void resizeWindow();
    void drawFrame();
    void record(VkCommandBuffer cmd, uint32_t slot, uint32_t image);
    void enlarge(VkCommandBuffer cmd, VkImage target) const;
    void collect(uint32_t slot);
    Shot describe(uint32_t slot);
    void refuse(const std::string& what);
    bool finished();

    Options options_;
    Window window_;
    samples::Device device_;
    Swapchain swapchain_;
    Overlay overlay_;
    State state_;
    History history_;
    std::optional<LiveShaders> shaders_;
    std::unique_ptr<Stage> stage_;
    std::unique_ptr<Picture> picture_;
    samples::FrameSlots slots_;
    std::optional<Script> script_;
    std::optional<WindowShot> windowShots_[samples::FrameSlots::kCount];
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();

    uint32_t frame_ = 0;
    float recordedTime_ = 0;     // of the animation in the last frame
    samples::CameraPose pose_;   // of the last frame
    uint32_t referenceFrames_ = 0;
    restir::Counters counters_;
    std::string loading_;        // a scene that the next frame waits for
    bool interrupted_ = false;   // this frame waited for something to be made
};

}   // namespace viewer
