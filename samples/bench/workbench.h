// A scene, and estimators that take turns on it.
#pragma once

#include <deque>
#include <limits>
#include <memory>

#include "bench/command.h"
#include "common/gpu_scene.h"
#include "common/renderer.h"
#include "common/scene_options.h"
#include "proof/measures.h"

namespace bench {

struct SceneOptions {
    samples::SceneOptions scene;
    VkExtent2D extent{320, 180};
    uint32_t frames = 30;
    float move = 0.2f;
    float zoom = 1;
    std::string animation;
    std::optional<restir::RayBackend> rays;
    restir::Settings settings;   // of every row, before its own settings
    std::vector<std::string> rows;
};
void addScene(CLI::App& command, SceneOptions& options);

// One estimator with a session of its own.
class Contender {
public:
    Contender(samples::Device& device, samples::GpuScene& scene, VkExtent2D extent,
              const samples::Sequence& sequence, std::string name, const restir::Settings& settings,
              std::optional<restir::RayBackend> rays);

    const std::string& name() const { return name_; }
    const restir::Settings& settings() const { return settings_; }
    samples::Renderer& renderer() { return *renderer_; }

    // The end of a sequence of so many frames, at least two.
    proof::FramePair render(uint32_t seed, uint32_t frames);
    double milliseconds() const { return best_; }   // GPU, of a frame; the best sequence so far
    double raysPerPixel() const;
    double bytesPerPixel() const;

private:
    std::string name_;
    restir::Settings settings_;
    VkExtent2D extent_;
    samples::Sequence sequence_;
    std::unique_ptr<samples::Renderer> renderer_;
    double best_ = std::numeric_limits<double>::infinity();
};

class Workbench {
public:
    explicit Workbench(const SceneOptions& options);

    Contender& add(const std::string& name, const restir::Settings& settings);
    samples::Device& device() { return device_; }
    samples::GpuScene& scene() { return *scene_; }
    std::deque<Contender>& contenders() { return contenders_; }   // the options' rows first, or "di"

private:
    VkExtent2D extent_;
    std::optional<restir::RayBackend> rays_;
    samples::Sequence sequence_;   // but for its frames and seed
    samples::Device device_;
    std::unique_ptr<samples::GpuScene> scene_;
    std::deque<Contender> contenders_;
};

// GPU milliseconds of each pass: the median over its frames.
double medianOf(const samples::PassStats& pass);

}   // namespace bench
