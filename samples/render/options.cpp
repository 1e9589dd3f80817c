#include "render/options.h"

#include <algorithm>
#include <stdexcept>

#include <CLI/CLI.hpp>

#include <restir/version.h>

#include "common/debug_views.h"
#include "common/setting_options.h"

namespace render {
namespace {

constexpr uint32_t kSettlingFrames = 16;   // of temporal reuse, near enough to its default history

#define RENDER_TEXT_OF(x) #x
#define RENDER_TEXT(x) RENDER_TEXT_OF(x)
constexpr const char* kVersion = RENDER_TEXT(RESTIR_VERSION_MAJOR) "." RENDER_TEXT(
    RESTIR_VERSION_MINOR) "." RENDER_TEXT(RESTIR_VERSION_PATCH);

// A linear picture under a PNG's name is one that no viewer opens.
CLI::Validator endsIn(const std::string& extension) {
    return CLI::Validator(
        [extension](const std::string& file) {
            return file.ends_with(extension) ? std::string() : "'" + file + "' must end in " + extension;
        },
        "");
}

void addPicture(CLI::App& app, Options& options) {
    app.add_option("scene", options.scene.scene,
                   samples::kSceneHelp)
        ->required()
        ->type_name("SCENE");
    samples::addSize(app, options.size, "picture size in pixels");
    app.add_option("--frames", options.frames, "frames to render (di: 16, else 1)")
        ->check(CLI::Range(1u, 1u << 24));
    app.add_flag("--accumulate", options.accumulate,
                 "write the mean of all frames, jittered; else the last frame");
    app.add_option("--seed", options.seed, "of all random numbers");
    app.add_option("--move", options.move, "orbit the target by so many degrees a frame")->type_name("DEG");
    app.add_option("--animate", options.animation, "one of the scene's animations, arriving at its time 0")
        ->type_name("NAME");
    app.add_flag("--jitter", options.jitter,
                 "jitter each frame over the pixel, as for temporal antialiasing");
    samples::addSceneOptions(app, options.scene);
    app.add_option("--out", options.exr, "linear picture")->type_name("FILE.exr")->check(endsIn(".exr"));
    app.add_option("--png", options.png, "tone-mapped picture")->type_name("FILE.png")->check(endsIn(".png"));
    app.add_option("--stats", options.stats, "times, rays and memory")->type_name("FILE.json");
    app.add_flag("--validate", options.validate, "run under the validation layer; its messages fail the run");
    app.add_flag("--quiet", options.quiet, "print errors only");
}

void addEstimator(CLI::App& app, Options& options, std::string& nextEvent) {
    app.add_option("--mode", options.mode,
                   "the path tracer that shares nothing with the SDK (reference), candidates alone (ris), " +
                       samples::settingOption("mode").help)
        ->type_name("reference|ris|" + samples::settingOption("mode").values);
    app.add_option_function<std::string>(
           "--lights",
           [&options](const std::string& text) {
               options.lighting.emitters = text == "gpu" ? samples::Emitters::Meshes : samples::Emitters::Uploaded;
           },
           "who makes lights of emissive triangles (host)")
        ->check(CLI::IsMember({"host", "gpu"}))
        ->type_name("host|gpu");
    samples::addRays(app, options.lighting.rays);
    app.add_option("--spp", options.spp, "reference: paths, nee: lights, per pixel and frame")
        ->check(CLI::Range(1u, 65536u));
    app.add_option("--bounces", options.bounces,
                   "scattering events of a path (reference: 1; gi, gi-only, pt-plain: 3)")
        ->check(CLI::Range(1u, 64u));
    samples::addSettingOptions(app, options.settings);
    app.add_option_function<std::string>(
           "--debug",
           [&options](const std::string& text) { options.settings.debugView = samples::findDebugView(text); },
           "show what the last frame's reservoirs hold: colours, and in the EXR's channel A numbers")
        ->type_name(samples::debugViewList());
    app.add_flag("!--no-previous-tlas", options.previousTlas,
                 "keep last frame's acceleration structure from the library");
    app.add_flag("--denoise", options.denoise, "filter the SDK's picture over frames and neighbours");
    // For checking the reference itself.
    app.add_option("--reference-nee", nextEvent)->check(CLI::IsMember({"on", "off"}))->group("");
}

void applyIndirect(Options& options) {
    const restir::GiSettings& gi = options.settings.gi;
    if (gi.mode == restir::IndirectMode::Off) {
        if (!options.reference() && options.bounces > 1)
            throw std::runtime_error("--bounces: --mode " + options.mode +
                                     " does not follow light further than one bounce");
        options.bounces = std::max(options.bounces, 1u);
        return;
    }
    if (options.bounces == 1)
        throw std::runtime_error("--bounces: indirect light is scattered twice at least");
    if (options.bounces > 0) options.settings.gi.bounces = options.bounces;
    if (gi.mode == restir::IndirectMode::Restir &&
        options.settings.di.visibility == restir::VisibilityReuse::None)
        throw std::runtime_error("--visibility: 'none' does not exist for indirect light");
}

void applyMode(Options& options) {
    restir::DiSettings& di = options.settings.di;
    const samples::SettingOption& mode = samples::settingOption("mode");
    if (!options.reference() && options.mode != "ris" && !mode.set(options.settings, options.mode))
        throw std::runtime_error("--mode: '" + options.mode + "' is none of reference|ris|" + mode.values);
    if (options.mode == "ris") {
        di.temporal = false;
        di.spatialPasses = 0;
    }
    if (di.mode == restir::DirectMode::NextEvent) di.lightCandidates = options.spp;
    if (options.debugs()) {
        if (di.mode != restir::DirectMode::Restir || options.reference())
            throw std::runtime_error("--debug: only --mode di, ris and gi have reservoirs to show");
        if (options.accumulate)
            throw std::runtime_error("--debug: shows one frame, not the mean of --accumulate");
    }
    if (options.denoise && (options.reference() || options.accumulate || options.debugs()))
        throw std::runtime_error("--denoise: filters frames of the SDK, not --mode reference, --accumulate or --debug");
    applyIndirect(options);
    samples::reuseAlike(options.settings);
    const bool settles = options.mode == "di" || options.settings.gi.mode == restir::IndirectMode::Restir;
    if (options.frames == 0) options.frames = settles ? kSettlingFrames : 1;
}

}   // namespace

std::optional<Options> parseOptions(int argc, const char* const* argv) {
    CLI::App app("Renders a scene with many lights by ReSTIR.", "restir-render");
    app.set_version_flag("--version", kVersion);
    Options options;
    std::string nextEvent;
    addPicture(app, options);
    addEstimator(app, options, nextEvent);
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& answer) {
        app.exit(answer);
        return std::nullopt;
    } catch (const CLI::ParseError& error) {
        throw std::runtime_error(error.what());
    }
    options.referenceNextEvent = nextEvent != "off";
    applyMode(options);
    samples::checkView(options.scene);
    return options;
}

}   // namespace render
