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

void placeTriangle(restir::Light& light, const LightSource& source, const glm::mat4& worldFromObject) {
    glm::vec3 p[3];
    for (int i = 0; i < 3; ++i) p[i] = glm::vec3(worldFromObject * glm::vec4(source.corners[i], 1.0f));
    copy(light.position, p[0]);
    copy(light.vertex1, p[1]);
    copy(light.vertex2, p[2]);
}

bool hasArea(const restir::Light& triangle) {
    const auto vector = [](const float(&v)[3]) { return glm::vec3(v[0], v[1], v[2]); };
    const glm::vec3 p = vector(triangle.position);
    const float doubleArea =
        glm::length(glm::cross(vector(triangle.vertex1) - p, vector(triangle.vertex2) - p));
    return doubleArea > 0 && std::isfinite(doubleArea);
}

restir::Light makePunctual(const PunctualLight& punctual, uint32_t id) {
    restir::Light light;
    light.id = id;
    light.kind = punctual.kind == PunctualKind::Point  ? restir::LightKind::Point
                 : punctual.kind == PunctualKind::Spot ? restir::LightKind::Spot
                                                       : restir::LightKind::Directional;
    copy(light.position, punctual.position);
    copy(light.direction, punctual.direction);
    copy(light.emission, punctual.intensity);
    light.range = punctual.range;
    light.innerCone = punctual.innerCone;
    light.outerCone = punctual.outerCone;
    if (punctual.profile == RS_NO_TEXTURE) return light;
    light.texture = punctual.profile;
    light.meanLuminance = luminance(punctual.intensity) * punctual.profileMean;
    const glm::quat& turn = punctual.profileTurn;
    const float rotation[] = {turn.x, turn.y, turn.z, turn.w};
    std::copy(rotation, rotation + 4, light.rotation);
    return light;
}

ReferenceLight makeReference(const PunctualLight& punctual) {
    ReferenceLight light;
    light.kind =
        punctual.kind == PunctualKind::Directional ? ReferenceKind::Directional : ReferenceKind::Local;
    light.position = punctual.position;
    light.direction = glm::normalize(punctual.direction);
    light.intensity = punctual.intensity;
    light.range = punctual.range;
    light.profile = punctual.profile;
    light.edge1 = punctual.profileTurn * glm::vec3(1, 0, 0);
    light.edge2 = punctual.profileTurn * glm::vec3(0, 0, 1);
    if (punctual.kind == PunctualKind::Spot) {
        const float outer = std::cos(punctual.outerCone);
        light.coneScale = 1.0f / std::max(0.001f, std::cos(punctual.innerCone) - outer);
        light.coneOffset = -outer * light.coneScale;
    }
    return light;
}

glm::vec3 toGlm(const float (&v)[3]) { return {v[0], v[1], v[2]}; }

ReferenceLight makeReference(const restir::Light& shape) {
    using restir::LightKind;
    ReferenceLight light;
    light.position = toGlm(shape.position);
    light.intensity = toGlm(shape.emission);
    light.radius = shape.radius;
    light.twoSided = shape.twoSided ? 1 : 0;
    switch (shape.kind) {
        case LightKind::Sphere:
        case LightKind::Capsule:
            light.kind = ReferenceKind::Capsule;
            light.direction =
                shape.kind == LightKind::Sphere ? glm::vec3(0) : toGlm(shape.vertex1) - light.position;
            light.twoSided = 0;
            break;
        case LightKind::Rectangle:
            light.kind = ReferenceKind::Rectangle;
            light.edge1 = toGlm(shape.vertex1) - light.position;
            light.edge2 = toGlm(shape.vertex2) - light.position;
            break;
        case LightKind::Disk:
            light.kind = ReferenceKind::Disk;
            light.direction = glm::normalize(toGlm(shape.direction));
            break;
        case LightKind::Directional:
            light.kind = ReferenceKind::Directional;
            light.direction = glm::normalize(toGlm(shape.direction));
            light.radius = shape.angularRadius;
            break;
        default:
            throw std::runtime_error("SceneData::shapes has a triangle, point, spot or environment light");
    }
    return light;
}

restir::Light makeSky(const Sky& sky, uint32_t texture, uint32_t id) {
    restir::Light light{.id = id, .kind = restir::LightKind::Environment, .texture = texture};
    copy(light.emission, glm::vec3(sky.scale));
    return light;
}
void turnSky(restir::Light& light, float rotation) {
    light.rotation[1] = std::sin(0.5f * rotation);
    light.rotation[3] = std::cos(0.5f * rotation);
}

class Collector {
public:
    explicit Collector(const SceneData& scene) : scene_(scene) {}

    SceneLights collect() {
        for (uint32_t i = 0; i < scene_.instances.size(); ++i) {
            for (const Geometry& geometry : scene_.meshes[scene_.instances[i].mesh].geometries)
                addGeometry(i, geometry);
        }
        result_.meshLights = static_cast<uint32_t>(nextId_);
        for (uint32_t i = 0; i < scene_.punctual.size(); ++i) addPunctual(i);
        for (uint32_t i = 0; i < scene_.shapes.size(); ++i) addShape(i);
        if (!scene_.sky.map.rgb.empty()) addSky();
        result_.idCount = static_cast<uint32_t>(nextId_);
        return std::move(result_);
    }

private:
    void addGeometry(uint32_t instance, const Geometry& geometry) {
        const RsMaterial& material = scene_.materials[geometry.material];
        const auto record = static_cast<uint32_t>(result_.firstLight.size());
        if (!(material.emission.x + material.emission.y + material.emission.z > 0)) {
            result_.firstLight.push_back(RS_NO_LIGHT);
            return;
        }
        const uint64_t count = geometry.indices.size() / 3;
        reserve(count);
        const auto firstLight = static_cast<uint32_t>(nextId_);
        result_.firstLight.push_back(firstLight);
        result_.meshes.push_back({record, firstLight, static_cast<uint32_t>(count)});
        for (uint32_t primitive = 0; primitive < count; ++primitive) {
            addTriangle(instance, geometry, material, primitive);
            if (result_.lights.size() > result_.reference.size()) {
                result_.reference.push_back({.record = record, .primitive = primitive});
            }
        }
        nextId_ += count;
        result_.emissiveTriangles += count;
    }

    void addTriangle(uint32_t instance, const Geometry& geometry, const RsMaterial& material,
                     uint32_t primitive) {
        const uint32_t* corners = &geometry.indices[size_t{3} * primitive];
        LightSource source{.from = instance, .material = geometry.material};
        for (int i = 0; i < 3; ++i) source.corners[i] = geometry.positions[corners[i]];
        restir::Light light;
        placeTriangle(light, source, scene_.instances[instance].worldFromObject);
        if (!hasArea(light)) return;
        light.id = static_cast<uint32_t>(nextId_) + primitive;
        light.twoSided = (material.flags & RS_MATERIAL_DOUBLE_SIDED) != 0;
        copy(light.emission, {material.emission.x, material.emission.y, material.emission.z});
        if (material.emissionTexture != RS_NO_TEXTURE) {
            addTexture(geometry, corners, material, light);
            if (light.meanLuminance == 0) return;
        }
        result_.lights.push_back(light);
        result_.sources.push_back(source);
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

    void addPunctual(uint32_t index) {
        const PunctualLight& punctual = scene_.punctual[index];
        if (!(luminance(punctual.intensity) > 0)) return;
        reserve(1);
        result_.lights.push_back(makePunctual(punctual, static_cast<uint32_t>(nextId_++)));
        result_.reference.push_back(makeReference(punctual));
        result_.sources.push_back({.kind = LightSource::Kind::Punctual, .from = index});
    }

    void addShape(uint32_t index) {
        reserve(1);
        result_.lights.push_back(scene_.shapes[index]);
        result_.lights.back().id = static_cast<uint32_t>(nextId_++);
        result_.reference.push_back(makeReference(scene_.shapes[index]));
        result_.sources.push_back({.kind = LightSource::Kind::Shape, .from = index});
    }

    // Its texture comes behind the scene's.
    void addSky() {
        reserve(1);
        const auto texture = static_cast<uint32_t>(scene_.textures.size());
        result_.lights.push_back(makeSky(scene_.sky, texture, static_cast<uint32_t>(nextId_++)));
        turnSky(result_.lights.back(), scene_.sky.rotation);
        result_.reference.push_back({.kind = ReferenceKind::Sky});
        result_.sources.push_back({.kind = LightSource::Kind::Sky});
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

std::vector<restir::Light> lightsAt(const SceneLights& rest, const SceneState& state, uint32_t firstId) {
    using Kind = LightSource::Kind;
    const auto first = std::partition_point(rest.lights.begin(), rest.lights.end(),
                                            [=](const restir::Light& light) { return light.id < firstId; });
    const auto begin = static_cast<size_t>(first - rest.lights.begin());
    std::vector<restir::Light> lights;
    lights.reserve(rest.lights.size() - begin);
    for (size_t i = begin; i < rest.lights.size(); ++i) {
        restir::Light light = rest.lights[i];
        const LightSource& source = rest.sources[i];
        const float factor = source.kind == Kind::Triangle ? state.emission[source.material] : 1;
        if (source.kind == Kind::Punctual) light = makePunctual(state.punctual[source.from], light.id);
        if (source.kind == Kind::Shape) {
            light = state.shapes[source.from];
            light.id = rest.lights[i].id;
        }
        if (source.kind == Kind::Sky) turnSky(light, state.skyRotation);
        if (source.kind == Kind::Triangle) {
            placeTriangle(light, source, state.worldFromObject[source.from]);
            for (float& channel : light.emission) channel *= factor;
            light.meanLuminance *= factor;   // negative, it still stands for "untextured"
        }
        if (factor > 0 && luminance(toGlm(light.emission)) > 0) lights.push_back(light);
    }
    return lights;
}

std::vector<ReferenceLight> referenceAt(const SceneLights& rest, const SceneState& state) {
    std::vector<ReferenceLight> lights = rest.reference;
    for (size_t i = 0; i < lights.size(); ++i) {
        const LightSource& source = rest.sources[i];
        if (source.kind == LightSource::Kind::Punctual)
            lights[i] = makeReference(state.punctual[source.from]);
        if (source.kind == LightSource::Kind::Shape) lights[i] = makeReference(state.shapes[source.from]);
    }
    return lights;
}

}   // namespace samples
