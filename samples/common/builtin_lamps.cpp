#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include "builtin.h"
#include "lamps.h"

namespace samples::build {

namespace {

// Metres. The floor is y = 0, with a wall at the back and one to the left, and the sky above.
constexpr float kHalf = 1.8f, kWall = 1.5f;

constexpr std::array<std::string_view, 12> kKinds = {"triangle",  "textured",    "sphere",      "disk",
                                                     "rectangle", "capsule",     "point",       "spot",
                                                     "profile",   "directional", "environment", "all"};
constexpr uint32_t kDirectional = 9, kEnvironment = 10, kAll = 11;
static_assert(kDirectional == kLampKinds);

// As many as there are kinds of lamps, of several powers, apart from the boxes and each other.
constexpr std::array<Lamp, kLampKinds> kLamps = {{
    {{-1.1f, 1.3f, -0.9f}, {-0.3f, -1, -0.2f}, 0.3f, 0.10f, {90, 66, 36}},
    {{-0.1f, 1.5f, -1.1f}, {0.2f, -1, -0.7f}, 1.1f, 0.12f, {5, 7, 11}},
    {{1.0f, 1.2f, -0.9f}, {0.2f, -1, -0.8f}, 2.0f, 0.07f, {20, 15, 14}},
    {{-1.2f, 1.0f, 0.2f}, {-0.8f, -1, 0.3f}, 0.7f, 0.08f, {4, 13, 8}},
    {{0.1f, 1.3f, 0.0f}, {0.1f, -1, 0.1f}, 2.6f, 0.06f, {50, 45, 36}},
    {{1.1f, 1.4f, 0.1f}, {-0.4f, -1, -0.3f}, 1.6f, 0.14f, {32, 20, 26}},
    {{-0.8f, 1.2f, 1.0f}, {-0.3f, -1, 0.4f}, 0.1f, 0.05f, {60, 52, 40}},
    {{0.3f, 1.0f, 0.9f}, {-0.1f, -1, -0.9f}, 2.2f, 0.09f, {8, 10, 13}},
    {{1.2f, 1.1f, 1.0f}, {0.2f, -1, 0.5f}, 0.9f, 0.10f, {14, 8, 4}},
}};

struct Sun {
    glm::vec3 direction;
    float angle;
    glm::vec3 irradiance;
};
// Soft and sharp; the last is without extent.
constexpr std::array<Sun, 4> kSuns = {{
    {{-0.5f, -1, -0.3f}, 0.06f, {1.6f, 1.3f, 0.9f}},
    {{-0.8f, -0.8f, -0.5f}, 0.25f, {0.9f, 0.4f, 0.2f}},
    {{0.1f, -1, -0.6f}, 0.005f, {0.3f, 0.6f, 0.9f}},
    {{-0.1f, -1, -0.1f}, 0, {0.2f, 0.25f, 0.2f}},
}};

restir::Light makeSun(const Sun& sun) {
    restir::Light light{.kind = restir::LightKind::Directional, .angularRadius = sun.angle};
    for (int i = 0; i < 3; ++i) {
        light.direction[i] = sun.direction[i];
        light.emission[i] = sun.irradiance[i];
    }
    return light;
}

// Dusk with three bright clouds.
FloatImage paintSky() {
    struct Cloud {
        glm::vec3 towards;
        float sharpness;
        glm::vec3 radiance;
    };
    const std::array<Cloud, 3> clouds = {{{{0.7f, 0.6f, 0.5f}, 60, {14, 9, 5}},
                                          {{-0.3f, 0.8f, 0.6f}, 25, {1, 2, 3.5f}},
                                          {{0.5f, 0.25f, 0.9f}, 120, {6, 2, 3}}}};
    FloatImage map{48, 24, {}};
    for (uint32_t y = 0; y < map.height; ++y)
        for (uint32_t x = 0; x < map.width; ++x) {
            const float phi = 2 * kPi * ((static_cast<float>(x) + 0.5f) / 48 - 0.5f);
            const float theta = kPi * (static_cast<float>(y) + 0.5f) / 24;
            const glm::vec3 d{std::sin(theta) * std::cos(phi), std::cos(theta),
                              std::sin(theta) * std::sin(phi)};
            glm::vec3 color =
                glm::mix(glm::vec3{0.2f, 0.12f, 0.1f}, glm::vec3{0.04f, 0.06f, 0.14f}, std::abs(d.y));
            for (const Cloud& cloud : clouds) {
                const float near = std::max(glm::dot(d, glm::normalize(cloud.towards)), 0.0f);
                color += std::pow(near, cloud.sharpness) * cloud.radiance;
            }
            map.rgb.insert(map.rgb.end(), {color.x, color.y, color.z});
        }
    return map;
}

void addStage(SceneData& scene) {
    Geometry room{.material =
                      addMaterial(scene, {.color = {0.7f, 0.68f, 0.64f}, .roughness = 1, .specular = 0})};
    const glm::vec3 x{2 * kHalf, 0, 0}, y{0, kWall, 0}, z{0, 0, 2 * kHalf}, corner{-kHalf, 0, -kHalf};
    addPatch(room, {.origin = corner + z, .u = x, .v = -z});
    addPatch(room, {.origin = corner, .u = x, .v = y});
    addPatch(room, {.origin = corner + z, .u = -z, .v = y});
    addInstance(scene, addMesh(scene, {room}));
    const auto addBlock = [&](const glm::vec3& foot, const glm::vec3& size, float turn,
                              const Surface& surface) {
        Geometry block{.material = addMaterial(scene, surface)};
        addBox(block, {-size.x / 2, 0, -size.z / 2}, {size.x / 2, size.y, size.z / 2});
        addInstance(scene, addMesh(scene, {block}), place(foot, turn));
    };
    const Surface red{.color = {0.6f, 0.2f, 0.15f}, .roughness = 1, .specular = 0};
    const Surface blue{.color = {0.25f, 0.35f, 0.6f}, .roughness = 1, .specular = 0};
    addBlock({-0.55f, 0, -0.45f}, {0.5f, 0.9f, 0.5f}, 0.5f, red);
    addBlock({0.55f, 0, -0.35f}, {0.5f, 0.5f, 0.5f}, -0.35f,
             {.color = {0.55f, 0.5f, 0.4f}, .roughness = 0.4f, .specular = 1});
    addBlock({-0.2f, 0, 0.6f}, {0.7f, 0.25f, 0.35f}, 0.2f, blue);
    addBlock({1.15f, 0, 0.55f}, {0.12f, 0.7f, 0.12f}, 0.6f, blue);
}

// Drifts, turns, swells and pulses, each at its own time.
Lamp moved(Lamp lamp, uint32_t index, float time) {
    const float phase = 0.7f * time + 2.1f * static_cast<float>(index);
    lamp.position += 0.06f * glm::vec3{std::sin(phase), std::cos(phase), std::sin(2 * phase)};
    lamp.aim += 0.3f * glm::vec3{std::cos(phase), 0, std::sin(phase)};
    lamp.spin += 0.4f * std::sin(0.8f * phase);
    lamp.size *= 1 + 0.25f * std::sin(1.3f * phase);
    lamp.radiance *= 1 + 0.4f * std::cos(0.9f * phase);
    return lamp;
}

Sun moved(Sun sun, uint32_t index, float time) {
    const float phase = 0.7f * time + 2.1f * static_cast<float>(index);
    sun.direction += 0.15f * glm::vec3{std::sin(phase), 0, std::cos(phase)};
    sun.angle *= 1 + 0.25f * std::sin(1.3f * phase);
    sun.irradiance *= 1 + 0.4f * std::cos(0.9f * phase);
    return sun;
}

uint32_t findKind(std::string_view name) {
    const auto found = std::find(kKinds.begin(), kKinds.end(), name);
    if (found != kKinds.end()) return static_cast<uint32_t>(found - kKinds.begin());
    std::string known;
    for (const std::string_view kind : kKinds) known += (known.empty() ? "" : ", ") + std::string{kind};
    throw std::runtime_error("builtin:lamps: no kind '" + std::string{name} + "', known: " + known);
}

}   // namespace

std::span<const std::string_view> lampKinds() { return kKinds; }

SceneData makeLamps(std::string_view name) {
    const uint32_t kind = findKind(name);
    SceneData scene{.name = "lamps, " + std::string{name}};
    addStage(scene);
    std::vector<Fitting> fittings;
    for (uint32_t i = 0; i < kLampKinds && (kind < kLampKinds || kind == kAll); ++i)
        fittings.push_back(addLamp(scene, static_cast<LampKind>(kind == kAll ? i : kind), kLamps[i]));
    const auto firstSun = static_cast<uint32_t>(scene.shapes.size());
    const auto suns = static_cast<uint32_t>(kind == kDirectional ? kSuns.size() : kind == kAll ? 1 : 0);
    for (uint32_t i = 0; i < suns; ++i) scene.shapes.push_back(makeSun(kSuns[i]));
    if (kind == kEnvironment || kind == kAll) scene.sky.map = paintSky();
    scene.views = {
        {.eye = {1.1f, 2.1f, 3.3f}, .target = {-0.1f, 0.35f, -0.1f}, .verticalFov = 0.72f, .name = "lamps"}};
    scene.animations = {{"lights", [=](float time, SceneState& state) {
                             for (uint32_t i = 0; i < fittings.size(); ++i)
                                 setLamp(state, fittings[i], kLamps[i], moved(kLamps[i], i, time));
                             for (uint32_t i = 0; i < suns; ++i)
                                 state.shapes[firstSun + i] = makeSun(moved(kSuns[i], i, time));
                             state.skyRotation = 0.1f * time;
                         }}};
    return scene;
}

}   // namespace samples::build
