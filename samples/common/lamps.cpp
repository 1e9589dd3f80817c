#include "lamps.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "ies.h"

namespace samples::build {

namespace {

using restir::Light;
using restir::LightKind;

// Throws forward, and a little to the sides.
constexpr std::string_view kPhotometry = R"(IESNA:LM-63-2002
TILT=NONE
1 -1 1 7 3 1 2 0 0 0
1 1 0
0 15 30 45 60 75 90
0 90 180
600 700 900 1000 700 200 0
600 550 450 300 150 50 0
600 450 300 150 60 20 0
)";

bool isMesh(LampKind kind) { return kind == LampKind::Triangle || kind == LampKind::Textured; }
bool isPunctual(LampKind kind) { return kind >= LampKind::Point; }

// Right-handed, the aim being -z as in photometry.
glm::mat3 axesOf(const Lamp& lamp) {
    const glm::vec3 z = -glm::normalize(lamp.aim);
    const glm::vec3 side = glm::normalize(glm::cross(glm::vec3{0.2f, 0.3f, 1}, z)), up = glm::cross(z, side);
    const glm::vec3 x = std::cos(lamp.spin) * side + std::sin(lamp.spin) * up;
    return {x, glm::cross(z, x), z};
}

glm::mat4 placeOf(const Lamp& lamp) {
    glm::mat4 place{lamp.size * axesOf(lamp)};
    place[3] = glm::vec4{lamp.position, 1};
    return place;
}

void copy(float (&to)[3], const glm::vec3& from) { std::copy(&from.x, &from.x + 3, to); }

// Both pi large, as placeOf() wants it.
Geometry triangle() {
    const float radius = std::sqrt(4 * kPi / (3 * std::sqrt(3.0f)));
    const auto at = [=](float angle) { return radius * glm::vec3{std::cos(angle), -std::sin(angle), 0}; };
    Geometry geometry;
    addTriangle(geometry, {at(0), at(2 * kPi / 3), at(4 * kPi / 3)});
    return geometry;
}
Geometry square() {
    const float side = std::sqrt(kPi);
    Geometry geometry;
    addPatch(geometry, {.origin = {-side / 2, -side / 2, 0}, .u = {0, side, 0}, .v = {side, 0, 0}});
    return geometry;
}

// Black in one corner, so that a triangle's mean is not its texture's.
Image paintPane() {
    return paint(8, 8, true, [](glm::vec2 uv) {
        const float light = uv.x + uv.y < 0.4f ? 0.0f : 1.0f;
        return glm::vec4(light * glm::vec3{0.2f + 0.8f * uv.x, 0.5f + 0.5f * uv.y, 1 - 0.7f * uv.x}, 1);
    });
}

Fitting addMeshLamp(SceneData& scene, LampKind kind, const Lamp& lamp) {
    const bool textured = kind == LampKind::Textured;
    Surface surface{.color = glm::vec3{0.1f}, .roughness = 1, .emission = lamp.radiance, .specular = 0.5f};
    if (textured) surface.emissionTexture = addTexture(scene, paintPane());
    Geometry geometry = textured ? square() : triangle();
    geometry.material = addMaterial(scene, surface);
    const Fitting fitting{kind, static_cast<uint32_t>(scene.instances.size()), geometry.material};
    addInstance(scene, addMesh(scene, {std::move(geometry)}), placeOf(lamp));
    return fitting;
}

void setShape(Light& light, LampKind kind, const Lamp& lamp) {
    const glm::mat3 axes = axesOf(lamp);
    copy(light.position, lamp.position);
    copy(light.emission, lamp.radiance);
    light.radius = lamp.size;
    switch (kind) {
        case LampKind::Disk:
            light.kind = LightKind::Disk;
            copy(light.direction, -axes[2]);
            break;
        case LampKind::Rectangle: {   // twice as long as wide
            const float width = lamp.size * std::sqrt(kPi / 2);
            const glm::vec3 corner = lamp.position - width * axes[0] - 0.5f * width * axes[1];
            light.kind = LightKind::Rectangle;
            copy(light.position, corner);
            copy(light.vertex1, corner + width * axes[1]);
            copy(light.vertex2, corner + 2 * width * axes[0]);
            break;
        }
        case LampKind::Capsule: {
            constexpr float kThin = 0.4f, kLong = kPi * (1 - kThin * kThin) / (2 * kThin);
            const glm::vec3 axis = kLong * lamp.size * axes[0];
            light.kind = LightKind::Capsule;
            light.radius = kThin * lamp.size;
            copy(light.position, lamp.position - 0.5f * axis);
            copy(light.vertex1, lamp.position + 0.5f * axis);
            break;
        }
        default:
            light.kind = LightKind::Sphere;
    }
}

void setPunctual(PunctualLight& light, const Lamp& lamp) {
    light.position = lamp.position;
    light.direction = glm::normalize(lamp.aim);
    light.intensity = kPi * lamp.size * lamp.size * lamp.radiance;
    light.profileTurn = glm::quat_cast(axesOf(lamp));
}

Fitting addPunctualLamp(SceneData& scene, LampKind kind, const Lamp& lamp) {
    PunctualLight light{.innerCone = 0.4f, .outerCone = 1.1f};
    const auto index = static_cast<uint32_t>(scene.punctual.size());
    if (kind == LampKind::Spot || (kind == LampKind::Profile && index % 2 == 1))
        light.kind = PunctualKind::Spot;
    if (kind == LampKind::Profile) {
        PhotometricProfile profile = readIes(kPhotometry);
        light.profile = addTexture(scene, std::move(profile.image));
        light.profileMean = profile.mean;
        scene.textures.back().wrapV = Wrap::Clamp;
    }
    setPunctual(light, lamp);
    scene.punctual.push_back(light);
    return {kind, index, 0};
}

}   // namespace

Fitting addLamp(SceneData& scene, LampKind kind, const Lamp& lamp) {
    if (isMesh(kind)) return addMeshLamp(scene, kind, lamp);
    if (isPunctual(kind)) return addPunctualLamp(scene, kind, lamp);
    setShape(scene.shapes.emplace_back(), kind, lamp);
    return {kind, static_cast<uint32_t>(scene.shapes.size() - 1), 0};
}

void setLamp(SceneState& state, const Fitting& fitting, const Lamp& rest, const Lamp& lamp) {
    if (isMesh(fitting.kind)) {
        state.worldFromObject[fitting.index] = placeOf(lamp);
        state.emission[fitting.material] = lamp.radiance.x / rest.radiance.x;
    } else if (isPunctual(fitting.kind)) {
        setPunctual(state.punctual[fitting.index], lamp);
    } else {
        setShape(state.shapes[fitting.index], fitting.kind, lamp);
    }
}

}   // namespace samples::build
