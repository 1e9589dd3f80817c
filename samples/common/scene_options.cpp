#include "common/scene_options.h"

#include <charconv>
#include <filesystem>
#include <stdexcept>

#include <CLI/CLI.hpp>

#include "common/sky.h"

namespace samples {
namespace {

constexpr uint32_t kLargestSide = 16384;

// `count` numbers with a separator between them and nothing else.
template <class T>
bool parseList(const std::string& text, char separator, T* values, size_t count) {
    const char* at = text.data();
    const char* end = at + text.size();
    for (size_t i = 0; i < count; ++i) {
        const auto [rest, error] = std::from_chars(at, end, values[i]);
        const bool last = i + 1 == count;
        if (error != std::errc{} || (last ? rest != end : rest == end || *rest != separator)) return false;
        at = last ? rest : rest + 1;
    }
    return true;
}

glm::vec3 parsePoint(const std::string& text, const char* option) {
    glm::vec3 point{0};
    if (!parseList(text, ',', &point[0], 3))
        throw std::runtime_error(std::string(option) + ": expected X,Y,Z, not '" + text + "'");
    return point;
}

}   // namespace

VkExtent2D parseSize(const std::string& text) {
    uint32_t sides[2] = {};
    if (!parseList(text, 'x', sides, 2)) throw std::runtime_error("--size: expected WxH, not '" + text + "'");
    for (const uint32_t side : sides) {
        if (side >= 1 && side <= kLargestSide) continue;
        throw std::runtime_error("--size: '" + text + "' has a side outside [1, " +
                                 std::to_string(kLargestSide) + "]");
    }
    return {sides[0], sides[1]};
}

void addSize(CLI::App& app, VkExtent2D& extent, const std::string& help) {
    const std::string usual = std::to_string(extent.width) + "x" + std::to_string(extent.height);
    app.add_option_function<std::string>(
           "--size", [&extent](const std::string& text) { extent = parseSize(text); },
           help + " (" + usual + ")")
        ->type_name("WxH");
}

std::span<const RayBackendName> rayBackends() {
    static constexpr RayBackendName kAll[] = {
        {restir::RayBackend::RayQuery, "query", "ray query on acceleration structures"},
        {restir::RayBackend::Pipeline, "pipeline", "ray tracing pipelines on acceleration structures"},
        {restir::RayBackend::Software, "software", "a BVH in storage buffers, walked in compute"},
    };
    return kAll;
}

const RayBackendName& rayBackend(std::string_view name) {
    std::string list;
    for (const RayBackendName& known : rayBackends()) {
        if (name == known.name) return known;
        list += (list.empty() ? "" : "|") + std::string(known.name);
    }
    throw std::runtime_error("'" + std::string(name) + "' is none of " + list);
}

const RayBackendName& rayBackend(restir::RayBackend backend) {
    for (const RayBackendName& known : rayBackends())
        if (backend == known.backend) return known;
    throw std::runtime_error("the samples do not know this ray backend");
}

void addRays(CLI::App& app, std::optional<restir::RayBackend>& rays) {
    std::vector<std::string> names;
    std::string list;
    for (const RayBackendName& known : rayBackends()) {
        names.emplace_back(known.name);
        list += (list.empty() ? "" : "|") + names.back();
    }
    app.add_option_function<std::string>(
           "--rays",
           [&rays](const std::string& text) { rays = rayBackend(text).backend; },
           "how the SDK traces rays (query; pipeline where the device has no ray query)")
        ->check(CLI::IsMember(names))
        ->type_name(list);
}

void addSceneOptions(CLI::App& app, SceneOptions& options) {
    auto* camera = app.add_option("--camera", options.camera, "one of the scene's cameras");
    camera->type_name("INDEX");
    app.add_option("--eye", options.eye, "camera position")->type_name("X,Y,Z")->excludes(camera);
    app.add_option("--target", options.target, "what the camera looks at")
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
}

std::string sceneText(const SceneOptions& options) {
    const SceneOptions usual;
    const auto number = [](float value) {
        char digits[32];
        return std::string(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
    };
    std::string text = options.scene;
    const auto add = [&text](const char* option, const std::string& value) { text += std::string(" ") + option + " " + value; };
    if (options.camera) add("--camera", std::to_string(*options.camera));
    if (!options.eye.empty()) add("--eye", options.eye);
    if (!options.target.empty()) add("--target", options.target);
    if (options.fov != usual.fov) add("--fov", number(options.fov));
    if (options.lambert) text += " --lambert";
    if (!options.environment.empty()) add("--env", std::filesystem::path(options.environment).filename().string());
    if (options.environmentRotation != usual.environmentRotation) add("--env-rotation", number(options.environmentRotation));
    if (options.environmentScale != usual.environmentScale) add("--env-scale", number(options.environmentScale));
    return text;
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
