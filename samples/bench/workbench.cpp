#include "bench/workbench.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "common/setting_options.h"

namespace bench {
namespace {

constexpr uint32_t kLoggedRays = 24;   // per pixel, at most

samples::View viewOf(const SceneOptions& options, const samples::SceneData& scene) {
    samples::View view = samples::chooseView(options.scene, scene);
    view.verticalFov = 2 * std::atan(std::tan(view.verticalFov / 2) / options.zoom);
    return view;
}

}   // namespace

double medianOf(const samples::PassStats& pass) {
    std::vector<double> values = pass.milliseconds;
    if (values.empty()) return 0;
    std::nth_element(values.begin(), values.begin() + long(values.size() / 2), values.end());
    return values[values.size() / 2];
}

void addScene(CLI::App& command, SceneOptions& options) {
    command.add_option("scene", options.scene.scene, "a glTF file or builtin:NAME")->required()->type_name("SCENE");
    samples::addSceneOptions(command, options.scene);
    samples::addSize(command, options.extent, "of the picture in pixels");
    command.add_option("--frames", options.frames, "of a sequence, the last of which is measured (30)")
        ->check(CLI::Range(2, 10000))
        ->type_name("N");
    command.add_option("--move", options.move, "the camera orbits its target by so much a frame (0.2)")
        ->type_name("DEG");
    command
        .add_option("--zoom", options.zoom,
                    "the middle of a picture so many times as wide and high: neighbours as near as there")
        ->check(CLI::Range(1.0, 1000.0))
        ->type_name("X");
    command.add_option("--animate", options.animation, "one of the scene's animations")->type_name("NAME");
    samples::addRays(command, options.rays);
    addRows(command, options.rows);
    samples::addSettingOptions(command, options.settings);
}

Contender::Contender(samples::Device& device, samples::GpuScene& scene, VkExtent2D extent,
                     const samples::Sequence& sequence, std::string name, const restir::Settings& settings,
                     std::optional<restir::RayBackend> rays)
    : name_(std::move(name)), settings_(settings), extent_(extent), sequence_(sequence) {
    restir::SessionDesc session{.rayLogCapacity = extent_.width * extent_.height * kLoggedRays};
    samples::declareFor(settings, session);
    renderer_ = std::make_unique<samples::Renderer>(device, scene, extent_, session, samples::LightingDesc{.rays = rays});
}

proof::FramePair Contender::render(uint32_t seed, uint32_t frames) {
    proof::FramePair pair;
    pair.before = {extent_.width, extent_.height, {}};
    samples::Sequence sequence = sequence_;
    sequence.frames = frames;
    sequence.seed = seed;
    sequence.eachFrame = [&](uint32_t index, std::span<const float> rgba) {
        if (index + 2 != frames) return;
        for (size_t i = 0; i < rgba.size(); ++i)
            if (i % 4 != 3) pair.before.rgb.push_back(rgba[i]);
    };
    pair.last = renderer_->render(sequence, settings_);
    double sum = 0;
    for (const samples::PassStats& pass : renderer_->stats().passes) sum += medianOf(pass);
    best_ = std::min(best_, sum);
    return pair;
}

double Contender::raysPerPixel() const {
    return double(renderer_->stats().counters.rays) / (double(extent_.width) * extent_.height);
}

double Contender::bytesPerPixel() const {
    double bytes = 0;
    for (const restir::BufferInfo& buffer : renderer_->memory())
        if (buffer.perPixel) bytes += double(buffer.bytes);
    return bytes / (double(extent_.width) * extent_.height);
}

Workbench::Workbench(const SceneOptions& options) : extent_(options.extent), rays_(options.rays) {
    samples::SceneData data = load(options.scene);
    sequence_ = {.view = viewOf(options, data), .orbitDegrees = options.move};
    if (!options.animation.empty()) sequence_.motion = samples::findMotion(data, options.animation);
    scene_ = std::make_unique<samples::GpuScene>(device_, std::move(data));
    std::printf("%s, %ux%u, %zu lights, %s\n", options.scene.scene.c_str(), options.extent.width,
                options.extent.height, scene_->lights().size(), device_.driver().c_str());
    for (const std::string& text : options.rows) {
        const proof::Row row = proof::parseRow(text, options.settings);
        add(row.name, samples::parseSettings(row.settings));
    }
    if (options.rows.empty()) {
        restir::Settings settings = options.settings;
        samples::reuseAlike(settings);
        add(samples::modeText(settings), settings);
    }
}

Contender& Workbench::add(const std::string& name, const restir::Settings& settings) {
    return contenders_.emplace_back(device_, *scene_, extent_, sequence_, name, settings, rays_);
}

}   // namespace bench
