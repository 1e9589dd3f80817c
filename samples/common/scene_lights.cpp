#include "common/scene_lights.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "common/emission_texture.h"

namespace samples {
namespace {

using restir::gpu::RsMaterial;

constexpr uint64_t kMostLights = 1u << 20;   // LightTableDesc::maxLights

void copy(float (&to)[3], const glm::vec3& from) {
    for (int i = 0; i < 3; ++i) to[i] = from[i];
}

class Collector {
public:
    explicit Collector(const SceneData& scene) : scene_(scene) {}

    SceneLights collect() {
        for (const Instance& instance : scene_.instances) {
            for (const Geometry& geometry : scene_.meshes[instance.mesh].geometries)
                addGeometry(instance, geometry);
        }
        for (const PunctualLight& light : scene_.punctual) addPunctual(light);
        result_.idCount = static_cast<uint32_t>(nextId_);
        return std::move(result_);
    }

private:
    void addGeometry(const Instance& instance, const Geometry& geometry) {
        const RsMaterial& material = scene_.materials[geometry.material];
        const auto record = static_cast<uint32_t>(result_.firstLight.size());
        if (!(material.emission.x + material.emission.y + material.emission.z > 0)) {
            result_.firstLight.push_back(RS_NO_LIGHT);
            return;
        }
        const uint64_t count = geometry.indices.size() / 3;
        reserve(count);
        result_.firstLight.push_back(static_cast<uint32_t>(nextId_));
        for (uint32_t primitive = 0; primitive < count; ++primitive) {
            addTriangle(instance, geometry, material, primitive);
            if (result_.lights.size() > result_.reference.size()) {
                result_.reference.push_back({.record = record, .primitive = primitive});
            }
        }
        nextId_ += count;
        result_.emissiveTriangles += count;
    }

    void addTriangle(const Instance& instance, const Geometry& geometry, const RsMaterial& material,
                     uint32_t primitive) {
        const uint32_t* corners = &geometry.indices[size_t{3} * primitive];
        glm::vec3 p[3];
        for (int i = 0; i < 3; ++i) {
            p[i] = glm::vec3(instance.worldFromObject * glm::vec4(geometry.positions[corners[i]], 1.0f));
        }
        const float doubleArea = glm::length(glm::cross(p[1] - p[0], p[2] - p[0]));
        if (!(doubleArea > 0) || !std::isfinite(doubleArea)) return;
        restir::Light light;
        light.id = static_cast<uint32_t>(nextId_) + primitive;
        light.twoSided = (material.flags & RS_MATERIAL_DOUBLE_SIDED) != 0;
        copy(light.position, p[0]);
        copy(light.vertex1, p[1]);
        copy(light.vertex2, p[2]);
        copy(light.emission, {material.emission.x, material.emission.y, material.emission.z});
        if (material.emissionTexture != RS_NO_TEXTURE) {
            addTexture(geometry, corners, material, light);
            if (light.meanLuminance == 0) return;
        }
        result_.lights.push_back(light);
    }

    void addTexture(const Geometry& geometry, const uint32_t* corners, const RsMaterial& material,
                    restir::Light& light) {
        glm::vec2 uv[3] = {glm::vec2(0), glm::vec2(0), glm::vec2(0)};
        for (int i = 0; i < 3 && !geometry.uvs.empty(); ++i) uv[i] = geometry.uvs[corners[i]];
        for (int i = 0; i < 3; ++i) {
            light.uv[i][0] = uv[i].x;
            light.uv[i][1] = uv[i].y;
        }
        light.texture = material.emissionTexture;
        const auto found = maps_.try_emplace(&material, scene_, material).first;
        light.meanLuminance = found->second.mean(uv);
    }

    void addPunctual(const PunctualLight& punctual) {
        if (!(luminance(punctual.intensity) > 0)) return;
        reserve(1);
        restir::Light light;
        light.id = static_cast<uint32_t>(nextId_++);
        light.kind = punctual.kind == PunctualKind::Point  ? restir::LightKind::Point
                     : punctual.kind == PunctualKind::Spot ? restir::LightKind::Spot
                                                           : restir::LightKind::Directional;
        copy(light.position, punctual.position);
        copy(light.direction, punctual.direction);
        copy(light.emission, punctual.intensity);
        light.range = punctual.range;
        light.innerCone = punctual.innerCone;
        light.outerCone = punctual.outerCone;
        result_.lights.push_back(light);
        addReference(punctual);
    }

    void addReference(const PunctualLight& punctual) {
        ReferenceLight light;
        light.kind =
            punctual.kind == PunctualKind::Directional ? ReferenceKind::Directional : ReferenceKind::Local;
        light.position = punctual.position;
        light.direction = glm::normalize(punctual.direction);
        light.intensity = punctual.intensity;
        light.range = punctual.range;
        if (punctual.kind == PunctualKind::Spot) {
            const float outer = std::cos(punctual.outerCone);
            light.coneScale = 1.0f / std::max(0.001f, std::cos(punctual.innerCone) - outer);
            light.coneOffset = -outer * light.coneScale;
        }
        result_.reference.push_back(light);
    }

    void reserve(uint64_t count) const {
        if (nextId_ + count <= kMostLights) return;
        throw std::runtime_error("the scene has more than " + std::to_string(kMostLights) +
                                 " emissive triangles and lights, the most a LightTable takes (maxLights)");
    }

    const SceneData& scene_;
    SceneLights result_;
    uint64_t nextId_ = 0;
    std::map<const RsMaterial*, EmissionMap> maps_;
};

}   // namespace

SceneLights makeSceneLights(const SceneData& scene) { return Collector(scene).collect(); }

}   // namespace samples
