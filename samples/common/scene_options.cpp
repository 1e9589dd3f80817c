#include "common/scene_options.h"

#include <array>
#include <charconv>
#include <stdexcept>

#include <CLI/CLI.hpp>

#include "common/sky.h"

namespace samples {
namespace {

glm::vec3 parsePoint(const std::string& text, const char* option) {
    glm::vec3 point{0};
    const char* at = text.data();
    const char* end = at + text.size();
    for (int i = 0; i < 3; ++i) {
        const auto [rest, error] = std::from_chars(at, end, point[i]);
        if (error != std::errc{} || (i == 2 ? rest != end : rest == end || *rest != ','))
            throw std::runtime_error(std::string(option) + ": expected X,Y,Z, not '" + text + "'");
        at = rest + 1;
    }
    return point;
}

}   // namespace

void addSceneOptions(CLI::App& app, SceneOptions& options) {
    auto* camera = app.add_option("--camera", options.camera, "one of the scene's cameras");
    camera->type_name("INDEX");
    app.add_option("--eye", options.eye, "camera position")->type_name("X,Y,Z")->excludes(camera);
    app.add_option("--target", options.target, "what the camera looks at")->type_name("X,Y,Z")->excludes(camera);
    app.add_option("--fov", options.fov, "vertical field of view (45)")->type_name("DEG")->excludes(camera);
    app.add_flag("--lambert", options.lambert, "make every material a diffuse one of its base colour");
    auto* environment = app.add_option("--env", options.environment, "environment map: a file, or builtin:sky");
    environment->type_name("FILE.hdr|.exr");
    app.add_option("--env-rotation", options.environmentRotation, "turns the map about the vertical")
        ->type_name("DEG")
        ->needs(environment);
    app.add_option("--env-scale", options.environmentScale, "factor on the map")
        ->check(CLI::Range(0.0, 1e9))
        ->needs(environment);
}

SceneData load(const SceneOptions& options, std::vector<std::string>& warnings) {
    SceneData scene = loadScene(options.scene, warnings);
    if (!options.environment.empty())
        scene.sky = {.map = loadSky(options.environment, warnings),
                     .rotation = glm::radians(options.environmentRotation),
                     .scale = options.environmentScale};
    if (options.lambert) makeLambert(scene);
    return scene;
}

void checkView(const SceneOptions& options) {
    if (options.eye.empty() != options.target.empty())
        throw std::runtime_error("--eye and --target need one another");
    if (!(options.fov > 0 && options.fov < 179)) throw std::runtime_error("--fov: outside (0, 179) degrees");
    if (!options.eye.empty() && parsePoint(options.eye, "--eye") == parsePoint(options.target, "--target"))
        throw std::runtime_error("--eye and --target are the same point");
}

View chooseView(const SceneOptions& options, const SceneData& scene) {
    checkView(options);
    if (!options.eye.empty())
        return {.eye = parsePoint(options.eye, "--eye"),
                .target = parsePoint(options.target, "--target"),
                .verticalFov = glm::radians(options.fov)};
    if (!options.camera) return scene.views.empty() ? frameScene(scene) : scene.views.front();
    if (*options.camera < scene.views.size()) return scene.views[*options.camera];
    throw std::runtime_error("--camera: " + std::to_string(*options.camera) + ", but the scene has " +
                             std::to_string(scene.views.size()) + " cameras, counted from 0");
}

}   // namespace samples
