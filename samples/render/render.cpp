#include "render/render.h"

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "common/reference.h"
#include "common/renderer.h"
#include "common/setting_options.h"

namespace render {
namespace {

samples::SceneData load(const Options& options) {
    std::vector<std::string> warnings;
    samples::SceneData scene = samples::load(options.scene, warnings);
    for (const std::string& warning : warnings) {
        if (!options.quiet) std::fprintf(stderr, "warning: %s\n", warning.c_str());
    }
    return scene;
}

samples::FloatImage renderReference(const Options& options, const samples::Device& device,
                                    samples::GpuScene& scene, const samples::Sequence& sequence,
                                    Report& report) {
    samples::Reference reference(device, scene, options.size);
    const samples::ReferenceSettings settings{
        .paths = options.spp, .bounces = options.bounces, .nextEvent = options.referenceNextEvent};
    samples::FloatImage image = reference.render(sequence, settings, Progress(options.quiet));
    report.raysPerFrame = reference.raysPerFrame();
    return image;
}

samples::FloatImage renderSdk(const Options& options, samples::Device& device, samples::GpuScene& scene,
                              const samples::Sequence& sequence, Report& report) {
    restir::SessionDesc session;
    samples::declareFor(options.settings, session);
    samples::Renderer renderer(device, scene, options.size, session, options.lighting);
    samples::FloatImage image = renderer.render(sequence, options.settings, Progress(options.quiet));
    report.passes = renderer.stats().passes;
    report.raysPerFrame = renderer.stats().counters.rays;
    report.rejectedWeights = renderer.stats().counters.rejectedWeights;
    report.buffers = renderer.memory();
    return image;
}

void writeText(const std::string& path, const std::string& text) {
    const std::string temporary = path + ".part";
    std::ofstream file(temporary, std::ios::binary);
    file << text;
    file.close();
    std::error_code error;
    if (file) std::filesystem::rename(temporary, path, error);
    if (!file || error) {
        std::filesystem::remove(temporary, error);
        throw std::runtime_error(path + ": cannot be written");
    }
}

}   // namespace

Outcome render(const Options& options) {
    samples::SceneData data = load(options);
    const samples::Sequence sequence{.view = samples::chooseView(options.scene, data),
                                     .frames = options.frames,
                                     .seed = options.seed,
                                     .accumulate = options.accumulate,
                                     .jitter = options.jitter || options.accumulate,
                                     .orbitDegrees = options.move,
                                     .motion = options.animation.empty()
                                                   ? samples::Motion()
                                                   : samples::findMotion(data, options.animation),
                                     .denoise = options.denoise,
                                     .previousTlas = options.previousTlas};
    samples::Device device({.validate = options.validate});
    Outcome outcome;
    Report& report = outcome.report;
    report.device = device.properties().deviceName;
    report.driver = device.driver();
    {
        samples::GpuScene scene(device, std::move(data));
        report.triangles = scene.triangleCount();
        report.emissiveTriangles = scene.emissiveTriangleCount();
        report.lights = scene.lights().size();
        const auto start = std::chrono::steady_clock::now();
        outcome.image = options.reference() ? renderReference(options, device, scene, sequence, report)
                                            : renderSdk(options, device, scene, sequence, report);
        report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }
    report.validationMessages = device.validationMessages();
    return outcome;
}

void writeFiles(const Options& options, const Outcome& outcome) {
    std::vector<std::string> written;
    const auto write = [&](const std::string& path, const auto& writer) {
        if (path.empty()) return;
        writer(path);
        written.push_back(path);
    };
    try {
        write(options.exr, [&](const std::string& path) { samples::writeExr(path, outcome.image); });
        write(options.png, [&](const std::string& path) {
            options.debugs() ? samples::writeColorsPng(path, outcome.image)
                             : samples::writePng(path, outcome.image);
        });
        write(options.stats,
              [&](const std::string& path) { writeText(path, toJson(options, outcome.report)); });
    } catch (...) {
        std::error_code ignored;
        for (const std::string& path : written) std::filesystem::remove(path, ignored);
        throw;
    }
}

}   // namespace render
