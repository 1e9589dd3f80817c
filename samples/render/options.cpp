#include "render/options.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <stdexcept>

#include <CLI/CLI.hpp>

#include <restir/version.h>

#include "common/setting_options.h"

namespace render {
namespace {

constexpr uint32_t kLargestSide = 16384;
constexpr uint32_t kSettlingFrames = 16;   // of temporal reuse, near enough to its default history

#define RENDER_TEXT_OF(x) #x
#define RENDER_TEXT(x) RENDER_TEXT_OF(x)
constexpr const char* kVersion = RENDER_TEXT(RESTIR_VERSION_MAJOR) "." RENDER_TEXT(
    RESTIR_VERSION_MINOR) "." RENDER_TEXT(RESTIR_VERSION_PATCH);

// Numbers with a separator between them and nothing else.
template <class T, size_t Count>
std::array<T, Count> parseList(const std::string& text, char separator, const char* option,
                               const char* form) {
    std::array<T, Count> values{};
    const char* at = text.data();
    const char* end = at + text.size();
    for (size_t i = 0; i < Count; ++i) {
        const auto [rest, error] = std::from_chars(at, end, values[i]);
        const bool lastOne = i + 1 == Count;
        if (error != std::errc{} || (lastOne ? rest != end : rest == end || *rest != separator)) {
            throw std::runtime_error(std::string(option) + ": expected " + form + ", not '" + text + "'");
        }
        at = lastOne ? rest : rest + 1;
    }
    return values;
}

std::optional<glm::vec3> parsePoint(const std::string& text, const char* option) {
    if (text.empty()) return std::nullopt;
    const auto values = parseList<float, 3>(text, ',', option, "X,Y,Z");
    return glm::vec3(values[0], values[1], values[2]);
}

struct Texts {
    std::string size, eye, target, nextEvent;
};

const std::map<std::string, restir::DebugView> kDebugViews = {{"age", restir::DebugView::Age},
                                                              {"confidence", restir::DebugView::Confidence},
                                                              {"duplicates", restir::DebugView::Duplicates},
                                                              {"light", restir::DebugView::Light},
                                                              {"neighbours", restir::DebugView::Neighbours},
                                                              {"samples", restir::DebugView::Samples},
                                                              {"visibility", restir::DebugView::Visibility},
                                                              {"weight", restir::DebugView::Weight}};

// An option whose value is one of a map's keys.
template <class T>
void addChoice(CLI::App& app, const char* name, T& value, const std::map<std::string, T>& choices,
               const char* help) {
    std::vector<std::string> names;
    std::string list;
    for (const auto& [key, unused] : choices) {
        names.push_back(key);
        list += (list.empty() ? "" : "|") + key;
    }
    app.add_option_function<std::string>(
           name,
           [&value, &choices, name, list](const std::string& text) {
               const auto found = choices.find(text);
               if (found == choices.end()) {
                   throw std::runtime_error(std::string(name) + ": '" + text + "' is none of " + list);
               }
               value = found->second;
           },
           help)
        ->type_name(list);
}

void addPicture(CLI::App& app, Options& options, Texts& texts) {
    app.add_option("scene", options.scene,
                   "a .gltf or .glb file, or builtin:cornell, builtin:market, builtin:street")
        ->required()
        ->type_name("SCENE");
    app.add_option("--size", texts.size, "picture size in pixels (640x360)")->type_name("WxH");
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
    auto* camera = app.add_option("--camera", options.camera, "one of the scene's cameras");
    camera->type_name("INDEX");
    app.add_option("--eye", texts.eye, "camera position")->type_name("X,Y,Z")->excludes(camera);
    app.add_option("--target", texts.target, "what the camera looks at")
        ->type_name("X,Y,Z")
        ->excludes(camera);
    app.add_option("--fov", options.fov, "vertical field of view (45)")->type_name("DEG")->excludes(camera);
    app.add_flag("--lambert", options.lambert, "make every material a diffuse one of its base colour");
    auto* environment =
        app.add_option("--env", options.environment, "environment map: a file, or builtin:sky");
    environment->type_name("FILE.hdr|.exr");
    app.add_option("--env-rotation", options.environmentRotation, "turns the map about the vertical")
        ->type_name("DEG")
        ->needs(environment);
    app.add_option("--env-scale", options.environmentScale, "factor on the map")
        ->check(CLI::Range(0.0, 1e9))
        ->needs(environment);
    app.add_option("--out", options.exr, "linear picture")->type_name("FILE.exr");
    app.add_option("--png", options.png, "tone-mapped picture")->type_name("FILE.png");
    app.add_option("--stats", options.stats, "times, rays and memory")->type_name("FILE.json");
    app.add_flag("--validate", options.validate, "run under the validation layer; its messages fail the run");
    app.add_flag("--quiet", options.quiet, "print errors only");
}

void addEstimator(CLI::App& app, Options& options, Texts& texts) {
    app.add_option("--mode", options.mode,
                   "the path tracer that shares nothing with the SDK (reference), candidates alone (ris), " +
                       samples::settingOption("mode").help)
        ->type_name("reference|ris|" + samples::settingOption("mode").values);
    app.add_option("--spp", options.spp, "reference: paths, nee: lights, per pixel and frame")
        ->check(CLI::Range(1u, 65536u));
    app.add_option("--bounces", options.bounces,
                   "scattering events of a path (reference: 1; gi, gi-only, pt-plain: 3)")
        ->check(CLI::Range(1u, 64u));
    samples::addSettingOptions(app, options.settings);
    addChoice(app, "--debug", options.settings.debugView, kDebugViews,
              "show what the last frame's reservoirs hold: colours, and in the EXR's channel A numbers");
    app.add_flag("!--no-previous-tlas", options.previousTlas,
                 "keep last frame's acceleration structure from the library");
    // For checking the reference itself.
    app.add_option("--reference-nee", texts.nextEvent)->check(CLI::IsMember({"on", "off"}))->group("");
}

void applySize(Options& options, const std::string& text) {
    if (text.empty()) return;
    const auto size = parseList<uint32_t, 2>(text, 'x', "--size", "WxH");
    for (uint32_t side : size) {
        if (side >= 1 && side <= kLargestSide) continue;
        throw std::runtime_error("--size: '" + text + "' has a side outside [1, " +
                                 std::to_string(kLargestSide) + "]");
    }
    options.size = {size[0], size[1]};
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
    applyIndirect(options);
    samples::reuseAlike(options.settings);
    const bool settles = options.mode == "di" || options.settings.gi.mode == restir::IndirectMode::Restir;
    if (options.frames == 0) options.frames = settles ? kSettlingFrames : 1;
}

void applyCamera(Options& options, const Texts& texts) {
    options.eye = parsePoint(texts.eye, "--eye");
    options.target = parsePoint(texts.target, "--target");
    if (options.eye.has_value() != options.target.has_value()) {
        throw std::runtime_error("--eye and --target need one another");
    }
    if (options.eye && *options.eye == *options.target)
        throw std::runtime_error("--eye and --target are the same point");
    if (!(options.fov > 0 && options.fov < 179)) throw std::runtime_error("--fov: outside (0, 179) degrees");
}

}   // namespace

std::optional<Options> parseOptions(int argc, const char* const* argv) {
    CLI::App app("Renders a scene with many lights by ReSTIR.", "restir-render");
    app.set_version_flag("--version", kVersion);
    Options options;
    Texts texts;
    addPicture(app, options, texts);
    addEstimator(app, options, texts);
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& answer) {
        app.exit(answer);
        return std::nullopt;
    } catch (const CLI::ParseError& error) {
        throw std::runtime_error(error.what());
    }
    options.referenceNextEvent = texts.nextEvent != "off";
    applySize(options, texts.size);
    applyMode(options);
    applyCamera(options, texts);
    return options;
}

samples::View chooseView(const Options& options, const samples::SceneData& scene) {
    samples::View view;
    if (options.eye) {
        view.eye = *options.eye;
        view.target = *options.target;
        view.verticalFov = glm::radians(options.fov);
        return view;
    }
    if (options.camera) {
        if (*options.camera >= scene.views.size()) {
            throw std::runtime_error("--camera: " + std::to_string(*options.camera) + ", but the scene has " +
                                     std::to_string(scene.views.size()) + " cameras, counted from 0");
        }
        return scene.views[*options.camera];
    }
    return scene.views.empty() ? samples::frameScene(scene) : scene.views.front();
}

}   // namespace render
