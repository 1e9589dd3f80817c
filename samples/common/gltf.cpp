#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include "bounds.h"
#include "gltf_reader.h"

namespace samples {

namespace {

using gltf::Materials;
using gltf::Profiles;
using gltf::Reader;

constexpr std::array kSupported = {
    "EXT_lights_ies",         "KHR_lights_punctual",   "KHR_materials_emissive_strength",
    "KHR_materials_specular", "KHR_mesh_quantization", "KHR_texture_transform"};
// Without these the file's geometry cannot be read at all.
constexpr std::array kGeometryExtensions = {"KHR_draco_mesh_compression", "EXT_meshopt_compression",
                                            "KHR_meshopt_compression", "EXT_mesh_gpu_instancing"};

template <size_t N>
bool contains(const std::array<const char*, N>& names, const std::string& name) {
    return std::any_of(names.begin(), names.end(), [&](const char* known) { return name == known; });
}

void checkExtensions(Reader& reader) {
    for (const std::string& name : reader.model().extensionsRequired)
        if (contains(kGeometryExtensions, name))
            reader.fail("extensionsRequired", name + " is not supported");
    for (const std::string& name : reader.model().extensionsUsed)
        if (!contains(kSupported, name)) reader.warn(name + " is ignored");
    if (!reader.model().skins.empty()) reader.warn("skins are ignored, meshes stay in their bind pose");
    if (!reader.model().animations.empty()) reader.warn("animations are ignored");
}

glm::vec3 vec3Of(const std::vector<double>& values, glm::vec3 otherwise) {
    return values.size() == 3 ? glm::vec3{values[0], values[1], values[2]} : otherwise;
}

glm::mat4 localTransform(const tinygltf::Node& node) {
    if (node.matrix.size() == 16) {
        glm::mat4 matrix;
        for (int i = 0; i < 16; ++i)
            matrix[i / 4][i % 4] = static_cast<float>(node.matrix[static_cast<size_t>(i)]);
        return matrix;
    }
    glm::quat rotation{1, 0, 0, 0};
    if (node.rotation.size() == 4) {
        const glm::dquat read{node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]};
        if (glm::dot(read, read) > 0) rotation = glm::quat(glm::normalize(read));
    }
    return glm::translate(glm::mat4{1}, vec3Of(node.translation, glm::vec3{0})) * glm::mat4_cast(rotation) *
           glm::scale(glm::mat4{1}, vec3Of(node.scale, glm::vec3{1}));
}

bool finite(const glm::mat4& matrix) {
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            if (!std::isfinite(matrix[column][row])) return false;
    return true;
}

// A unit vector even where the node is scaled by zero.
glm::vec3 direction(const glm::mat4& worldFromNode, const glm::vec3& axis) {
    const glm::vec3 world = glm::mat3{worldFromNode} * axis;
    const float length = glm::length(world);
    return length > 0 && std::isfinite(length) ? world / length : axis;
}

class SceneReader {
public:
    SceneReader(Reader& reader, SceneData& scene)
        : reader_(reader),
          scene_(scene),
          materials_(reader, scene),
          profiles_(reader, scene),
          meshes_(reader.model().meshes.size()) {}

    void read() {
        std::vector<Visit> stack;
        for (const int root : roots()) stack.push_back({root, glm::mat4{1}, "scene.nodes"});
        std::reverse(stack.begin(), stack.end());
        std::vector<bool> seen(reader_.model().nodes.size());
        while (!stack.empty()) {
            const Visit visit = stack.back();
            stack.pop_back();
            const size_t index = reader_.checkedIndex(visit.node, seen.size(), visit.field);
            const std::string field = "nodes[" + std::to_string(index) + "]";
            if (seen[index]) reader_.fail(field, "reached twice: a cycle, or a child of two nodes");
            seen[index] = true;
            const auto& node = reader_.model().nodes[index];
            const glm::mat4 world = visit.worldFromParent * localTransform(node);
            if (!finite(world)) reader_.fail(field, "its transform is not finite");
            readNode(node, world, field);
            for (auto child = node.children.rbegin(); child != node.children.rend(); ++child)
                stack.push_back({*child, world, field + ".children"});
        }
        aimViews();
    }

private:
    struct Visit {
        int node;
        glm::mat4 worldFromParent;
        std::string field;
    };

    std::vector<int> roots() {
        const auto& model = reader_.model();
        if (model.scenes.empty()) {
            reader_.warn("no scene: nothing is shown");
            return {};
        }
        const int scene = std::max(model.defaultScene, 0);
        return model.scenes[reader_.checkedIndex(scene, model.scenes.size(), "scene")].nodes;
    }

    void readNode(const tinygltf::Node& node, const glm::mat4& world, const std::string& field) {
        if (node.mesh >= 0) addInstance(node.mesh, world, field);
        if (node.camera >= 0) addView(node, world, field);
        if (node.extensions.contains("EXT_mesh_gpu_instancing"))
            reader_.warn("EXT_mesh_gpu_instancing is ignored");
        if (const auto ies = node.extensions.find("EXT_lights_ies");
            ies != node.extensions.end() && ies->second.IsObject())
            profiles_.addLight(ies->second, world, field + ".EXT_lights_ies");
        const auto light = node.extensions.find("KHR_lights_punctual");
        if (light == node.extensions.end() || !light->second.IsObject()) return;
        const tinygltf::Value& index = light->second.Get("light");
        addLight(index.IsInt() ? index.GetNumberAsInt() : -1, world, field + ".KHR_lights_punctual.light");
    }

    void addInstance(int gltfMesh, const glm::mat4& world, const std::string& field) {
        std::optional<uint32_t>& mesh =
            meshes_[reader_.checkedIndex(gltfMesh, meshes_.size(), field + ".mesh")];
        if (!mesh) {
            Mesh converted = convertMesh(reader_, materials_, static_cast<size_t>(gltfMesh));
            for (const Geometry& geometry : converted.geometries) indexCount_ += geometry.indices.size();
            constexpr size_t kMaxIndices = size_t{3} << 28;
            if (indexCount_ > kMaxIndices) reader_.fail("meshes", "more than 2^28 triangles");
            mesh = kEmptyMesh;
            if (!converted.geometries.empty()) {
                mesh = static_cast<uint32_t>(scene_.meshes.size());
                scene_.meshes.push_back(std::move(converted));
            }
        }
        if (*mesh != kEmptyMesh) scene_.instances.push_back({.mesh = *mesh, .worldFromObject = world});
    }

    void addView(const tinygltf::Node& node, const glm::mat4& world, const std::string& field) {
        const auto& cameras = reader_.model().cameras;
        const auto& camera = cameras[reader_.checkedIndex(node.camera, cameras.size(), field + ".camera")];
        if (camera.type != "perspective") {
            reader_.warn("orthographic cameras are skipped");
            return;
        }
        const double fov = camera.perspective.yfov;
        if (!(fov > 0 && fov < 3.14)) reader_.fail(field + ".camera", "yfov must be in (0, pi)");
        View view;
        view.eye = glm::vec3{world[3]};
        view.target = view.eye + direction(world, {0, 0, -1});
        view.up = direction(world, {0, 1, 0});
        view.verticalFov = static_cast<float>(fov);
        view.name = !camera.name.empty() ? camera.name : node.name;
        scene_.views.push_back(std::move(view));
    }

    void addLight(int index, const glm::mat4& world, const std::string& field) {
        const auto& lights = reader_.model().lights;
        const auto& light = lights[reader_.checkedIndex(index, lights.size(), field)];
        PunctualLight out;
        if (light.type == "spot")
            out.kind = PunctualKind::Spot;
        else if (light.type == "directional")
            out.kind = PunctualKind::Directional;
        else if (light.type != "point")
            reader_.fail(field, "unknown type " + light.type);
        out.position = glm::vec3{world[3]};
        out.direction = direction(world, {0, 0, -1});
        out.intensity = vec3Of(light.color, glm::vec3{1}) * static_cast<float>(light.intensity);
        const float sum = out.intensity.x + out.intensity.y + out.intensity.z;
        if (!std::isfinite(sum) || std::min({out.intensity.x, out.intensity.y, out.intensity.z}) < 0)
            reader_.fail(field, "color or intensity negative or not finite");
        out.range = std::isfinite(light.range) ? std::max(static_cast<float>(light.range), 0.0f) : 0.0f;
        out.innerCone = static_cast<float>(light.spot.innerConeAngle);
        out.outerCone = static_cast<float>(light.spot.outerConeAngle);
        constexpr float kRightAngle = 1.5707964f;
        if (!(out.innerCone >= 0 && out.innerCone < out.outerCone && out.outerCone <= kRightAngle))
            reader_.fail(field, "cone angles must satisfy 0 <= inner < outer <= pi / 2");
        scene_.punctual.push_back(out);
    }

    // Puts each target as far away as the scene's centre, which makes it a sensible point to orbit.
    void aimViews() {
        if (scene_.views.empty()) return;
        const Bounds bounds = sceneBounds(scene_);
        for (View& view : scene_.views) {
            const float radius = bounds.empty() ? 1.0f : 0.5f * glm::length(bounds.hi - bounds.lo);
            const float distance = bounds.empty() ? 1.0f : glm::distance(bounds.centre(), view.eye);
            view.target = view.eye + (view.target - view.eye) * std::max({distance, 0.1f * radius, 1e-3f});
        }
    }

    static constexpr uint32_t kEmptyMesh = UINT32_MAX;   // converted, but nothing to draw in it
    Reader& reader_;
    SceneData& scene_;
    Materials materials_;
    Profiles profiles_;
    std::vector<std::optional<uint32_t>> meshes_;
    size_t indexCount_ = 0;
};

}   // namespace

SceneData loadGltf(const std::string& path, std::vector<std::string>& warnings) {
    try {
        SceneData scene;
        Reader reader(path, warnings);
        checkExtensions(reader);
        SceneReader(reader, scene).read();
        const size_t slash = path.find_last_of("/\\");
        const std::string file = slash == std::string::npos ? path : path.substr(slash + 1);
        scene.name = file.substr(0, file.find_last_of('.'));
        return scene;
    } catch (const std::bad_alloc&) {
        throw std::runtime_error(path + ": not enough memory");
    }
}

}   // namespace samples
