#include "viewer/options.h"

#include <stdexcept>

#include <CLI/CLI.hpp>

#include "common/setting_options.h"

namespace viewer {

std::optional<Options> parseOptions(int argc, const char* const* argv) {
    CLI::App app("Shows a scene with many lights, lit by ReSTIR, in a window.", "restir-viewer");
    Options options;
    app.add_option("scene", options.scene.scene,
                   samples::kSceneHelp)
        ->default_val("builtin:market")
        ->type_name("SCENE");
    samples::addSize(app, options.window, "of the window");
    app.add_option("--scale", options.scale,
                   "pixels rendered for one of the window's, a side (1; on a CPU 0.25)")
        ->check(CLI::Range(0.05, 1.0));
    samples::addSceneOptions(app, options.scene);
    samples::addRays(app, options.rays);
    samples::addSettingOptions(app, options.settings);
    app.add_option("--bridge", options.bridge,
                   "a directory with a restir_bridge.glsl for the library's passes, which are compiled again "
                   "when a shader changes")
        ->type_name("DIR");
    auto* script = app.add_option("--script", options.script, "do what a file says, then quit; see README");
    script->type_name("FILE");
    app.add_option("--seconds", options.seconds, "begin the script anew until so much time has passed")
        ->type_name("N")
        ->needs(script);
    app.add_flag("--validate", options.validate, "run under the validation layer; its messages fail the run");
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& answer) {
        app.exit(answer);
        return std::nullopt;
    } catch (const CLI::ParseError& error) {
        throw std::runtime_error(error.what());
    }
    samples::checkView(options.scene);
    samples::reuseAlike(options.settings);
    return options;
}

}   // namespace viewer
