#include "image/plays.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <support/closed_form.h>

#include "image/stage.h"
#include "image/world.h"

namespace tests {
namespace {

using restir::Light;
using samples::build::Patch;

// Still. Two lamps of different colours, a blocker that hides either from another part of the plane, and a
// lamp that shines away from it.
class Shadows : public Play {
public:
    Shadows(const Patch& red, const Patch& blue, const Patch& blocker)
        : red_(red), blue_(blue), blocker_(blocker) {
        samples::SceneData data = planeScene();
        addQuad(data, red, {.color = {0, 0, 0}, .emission = kRedRadiance});
        addQuad(data, blue, {.color = {0, 0, 0}, .emission = kBlueRadiance});
        addQuad(data, blocker, {.color = {0, 0, 0}, .specular = 0});
        addQuad(data, {.origin = kAway.origin, .u = kAway.v, .v = kAway.u},
                {.color = {0, 0, 0}, .emission = {5, 5, 5}});
        view = data.views[0];
        scene = std::make_unique<samples::GpuScene>(device(), std::move(data));
    }
    void setUp(HostView&, uint32_t, uint32_t) const override {}
    samples::FloatImage truth() const override {
        return planePicture(view, kExtent, 1, [&](glm::dvec3 p) {
            return glm::dvec3(kRedRadiance) * irradiance(red_, p) +
                   glm::dvec3(kBlueRadiance) * irradiance(blue_, p);
        });
    }

private:
    // Less what the blocker's shadow, cast from the point onto the lamp, covers of it.
    double irradiance(const Patch& lit, glm::dvec3 p) const {
        const double scale = double(lit.origin.y) / double(blocker_.origin.y);
        const auto span = [&](int axis, const Patch& patch, double stretch) {
            const double from = double(patch.origin[axis]), length = double(patch.u[axis] + patch.v[axis]);
            const double a = p[axis] + (from - p[axis]) * stretch,
                         b = p[axis] + (from + length - p[axis]) * stretch;
            return std::pair(std::min(a, b), std::max(a, b));
        };
        double low[2], high[2];
        for (int k = 0; k < 2; ++k) {
            const auto [lampFrom, lampTo] = span(2 * k, lit, 1);
            const auto [from, to] = span(2 * k, blocker_, scale);
            low[k] = std::max(lampFrom, from);
            high[k] = std::min(lampTo, to);
            if (low[k] >= high[k]) return lampIrradiance(lit, p);
        }
        const Patch hidden{.origin = {low[0], lit.origin.y, low[1]},
                           .u = {high[0] - low[0], 0, 0},
                           .v = {0, 0, high[1] - low[1]}};
        return lampIrradiance(lit, p) - lampIrradiance(hidden, p);
    }

    Patch red_, blue_, blocker_;
    static inline const Patch kAway = lamp({0, 2.4f, -1.5f}, 0.3f);
    static constexpr glm::vec3 kRedRadiance{9, 4, 1}, kBlueRadiance{2, 4, 9};
};

// Nothing stands still: the camera goes round, one light blinks, one grows, one moves, one appears in the
// last frame, and one that lights only what is in front of it advances.
class Changes : public Play {
public:
    Changes() {
        samples::SceneData data = planeScene();
        view = data.views[0];
        scene = std::make_unique<samples::GpuScene>(device(), std::move(data));
    }
    void setUp(HostView& host, uint32_t frame, uint32_t frames) const override {
        const float left = float(frames - 1 - frame);
        host.look(samples::orbit(view, -25 * left));
        host.upload(lights(left));
    }
    samples::FloatImage truth() const override {
        const std::vector<Light> last = lights(0);
        return planePicture(view, kExtent, 1, [&](glm::dvec3 p) {
            glm::dvec3 sum(0);
            for (const Light& light : last) sum += lightIrradiance(light, p, {0, 1, 0});
            return sum;
        });
    }

private:
    static Light triangle(uint32_t id, glm::vec3 centre, glm::vec3 u, glm::vec3 v, glm::vec3 radiance) {
        Light light{.id = id};
        for (int i = 0; i < 3; ++i) {
            light.position[i] = centre[i] - u[i] - 0.6f * v[i];
            light.vertex1[i] = centre[i] + u[i] - 0.6f * v[i];
            light.vertex2[i] = centre[i] + 1.2f * v[i];
            light.emission[i] = radiance[i];
        }
        return light;
    }
    // Facing down.
    static Light hanging(uint32_t id, glm::vec3 centre, float size, glm::vec3 radiance) {
        return triangle(id, centre, {size, 0, 0}, {0, 0, size}, radiance);
    }
    // Facing +x.
    static Light standing(uint32_t id, glm::vec3 centre, float size, glm::vec3 radiance) {
        return triangle(id, centre, {0, size, 0}, {0, 0, size}, radiance);
    }
    static std::vector<Light> lights(float framesLeft) {
        std::vector<Light> all{
            hanging(0, {-0.5f, 0.5f, -0.2f}, 0.15f, {4, 4, 4}),
            hanging(1, {0.4f, 0.6f, -0.3f}, 0.15f,
                    int(framesLeft) % 2 == 0 ? glm::vec3(8, 2, 1) : glm::vec3(1, 0.2f, 0.1f)),
            hanging(2, {0.1f, 0.7f, 0.3f}, 0.2f * std::pow(0.7f, framesLeft), {1, 7, 2}),
            hanging(4, {0.5f - 0.3f * framesLeft, 0.4f, 0.2f}, 0.1f, {2, 2, 9}),
            standing(5, {-0.15f + 0.1f * framesLeft, 0.3f, 0}, 0.2f, {12, 9, 6})};
        if (framesLeft == 0) all.push_back(hanging(3, {-0.2f, 0.5f, 0.1f}, 0.12f, {3, 3, 6}));
        return all;
    }
};

// Still. Lights whose points are drawn for the receiver.
class Ball : public Play {
public:
    Ball() {
        samples::SceneData data = planeScene();
        view = data.views[0];
        scene = std::make_unique<samples::GpuScene>(device(), std::move(data));
    }
    void setUp(HostView& host, uint32_t, uint32_t) const override {
        const glm::vec3 corner = kPanel.origin, next = corner + kPanel.u, last = corner + kPanel.v;
        host.upload(std::array{Light{.id = 0,
                                     .kind = restir::LightKind::Sphere,
                                     .position = {-0.3f, 0.5f, -0.1f},
                                     .radius = kRadius,
                                     .emission = {3, 2, 1}},
                               Light{.id = 1,
                                     .kind = restir::LightKind::Rectangle,
                                     .position = {corner.x, corner.y, corner.z},
                                     .vertex1 = {next.x, next.y, next.z},
                                     .vertex2 = {last.x, last.y, last.z},
                                     .emission = {1, 2, 3}}});
    }
    samples::FloatImage truth() const override {
        return planePicture(view, kExtent, 1, [](glm::dvec3 p) {
            return glm::dvec3(3, 2, 1) * sphereIrradiance(glm::dvec3(-0.3f, 0.5f, -0.1f) - p, double(kRadius)) +
                   glm::dvec3(1, 2, 3) * lampIrradiance(kPanel, p);
        });
    }

private:
    static constexpr float kRadius = 0.4f;
    static inline const Patch kPanel = lamp({0.4f, 0.3f, 0.1f}, 0.3f);
};

// Still. Level light shines on one side of a card that stands on the plane, and passes over the plane itself; some more
// comes from above, so that nothing is black behind the card.
class Card : public Play {
public:
    Card() {
        samples::SceneData data = planeScene();
        addQuad(data, kCard, {.color = glm::vec3(kAlbedoOfCard), .roughness = 1, .specular = 0});
        view = data.views[0];
        scene = std::make_unique<samples::GpuScene>(device(), std::move(data));
    }
    void setUp(HostView& host, uint32_t frame, uint32_t) const override {
        if (frame > 0) return;
        const Light above{.id = 0, .kind = restir::LightKind::Directional, .direction = {0, -1, 0}, .emission = {1, 1, 1}};
        const Light level{.id = 1,
                          .kind = restir::LightKind::Directional,
                          .direction = {-1, 0, 0},
                          .emission = {kLevel[0], kLevel[1], kLevel[2]}};
        host.upload(std::array{above, level});
    }
    samples::FloatImage truth() const override {
        const glm::dvec3 radiance = glm::dvec3(kLevel[0], kLevel[1], kLevel[2]) * double(kAlbedoOfCard) / std::numbers::pi;
        return planePicture(view, kExtent, 1, [&](glm::dvec3 p) {
            return glm::dvec3(1) + (p.x > 0 ? radiance * lampIrradiance(kCard, p) : glm::dvec3(0));
        });
    }

private:
    // Facing +x.
    static inline const Patch kCard{.origin = {0, 0.02f, 0.4f}, .u = {0, 0, -0.8f}, .v = {0, 0.6f, 0}};
    static constexpr float kLevel[3] = {12, 8, 6}, kAlbedoOfCard = 0.8f;
};

}   // namespace

const Play& play(Stage stage) {
    if (stage == Stage::Card) {
        static const Card card;
        return card;
    }
    if (stage == Stage::Ball) {
        static const Ball ball;
        return ball;
    }
    if (stage == Stage::NearShadows) {
        static const Shadows shadows(lamp({-0.65f, 1.2f, 0}, 0.6f), lamp({0.65f, 1.25f, 0}, 0.6f),
                                     lamp({0, 0.95f, -0.05f}, 0.35f));
        return shadows;
    }
    if (stage == Stage::Changes) {
        static const Changes changes;
        return changes;
    }
    static const Shadows shadows(lamp({-0.5f, 2.2f, -0.3f}, 0.3f), lamp({0.6f, 2, 0}, 0.25f),
                                 lamp({0.05f, 0.95f, -0.05f}, 0.22f));
    return shadows;
}

}   // namespace tests
