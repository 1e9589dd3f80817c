#include "scene.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "bounds.h"

namespace samples {

namespace {

Bounds meshBounds(const Mesh& mesh) {
    Bounds bounds;
    for (const Geometry& geometry : mesh.geometries)
        for (const glm::vec3& position : geometry.positions) bounds.add(position);
    return bounds;
}

glm::vec3 corner(const Bounds& bounds, int index) {
    return {index & 1 ? bounds.hi.x : bounds.lo.x, index & 2 ? bounds.hi.y : bounds.lo.y,
            index & 4 ? bounds.hi.z : bounds.lo.z};
}

// Distance from the box's centre along `back` at which the corner is inside the square view pyramid.
float distanceToSee(const glm::vec3& offset, const glm::mat3& rightUpBack, float tangent) {
    const glm::vec3 local = glm::transpose(rightUpBack) * offset;
    return local.z + std::max(std::abs(local.x), std::abs(local.y)) / tangent;
}

}   // namespace

Bounds sceneBounds(const SceneData& scene) {
    std::vector<Bounds> meshes;
    for (const Mesh& mesh : scene.meshes) meshes.push_back(meshBounds(mesh));
    Bounds bounds;
    for (const Instance& instance : scene.instances) {
        if (meshes[instance.mesh].empty()) continue;
        for (int i = 0; i < 8; ++i)
            bounds.add(glm::vec3{instance.worldFromObject * glm::vec4{corner(meshes[instance.mesh], i), 1}});
    }
    return bounds;
}

SceneState restOf(const SceneData& scene) {
    SceneState state;
    for (const Instance& instance : scene.instances)
        state.worldFromObject.push_back(instance.worldFromObject);
    state.emission.assign(scene.materials.size(), 1.0f);
    state.punctual = scene.punctual;
    state.shapes = scene.shapes;
    state.skyRotation = scene.sky.rotation;
    return state;
}

Motion findMotion(const SceneData& scene, std::string_view animation) {
    std::string names;
    for (const Animation& known : scene.animations) {
        if (known.name == animation) return known.motion;
        names += (names.empty() ? "" : ", ") + known.name;
    }
    throw std::runtime_error("animation '" + std::string(animation) + "': the scene has " +
                             (names.empty() ? "none" : names));
}

View frameScene(const SceneData& scene) {
    View view;
    view.name = "frame";
    const Bounds bounds = sceneBounds(scene);
    if (bounds.empty()) return view;
    view.target = bounds.centre();
    const glm::vec3 back = glm::normalize(glm::vec3{0.45f, 0.4f, 1.0f});
    const glm::vec3 right = glm::normalize(glm::cross(view.up, back));
    const glm::mat3 rightUpBack{right, glm::cross(back, right), back};
    // The vertical angle is the smaller one down to square pictures, so fitting a square pyramid fits all.
    const float tangent = std::tan(0.5f * view.verticalFov);
    float distance = 0;
    for (int i = 0; i < 8; ++i)
        distance = std::max(distance, distanceToSee(corner(bounds, i) - view.target, rightUpBack, tangent));
    constexpr float kMargin = 1.05f;
    const float smallest = 1e-3f * std::max(1.0f, glm::length(view.target));
    view.eye = view.target + back * std::max(kMargin * distance, smallest);
    return view;
}

void makeLambert(SceneData& scene) {
    for (restir::gpu::RsMaterial& material : scene.materials) {
        material.specular = 0;
        material.metalness = 0;
        material.roughness = 1;
        material.metallicRoughnessTexture = RS_NO_TEXTURE;
        material.normalTexture = RS_NO_TEXTURE;
        material.flags &= ~RS_MATERIAL_ALPHA_MASK;
    }
}

}   // namespace samples
