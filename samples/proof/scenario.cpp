#include "proof/scenario.h"

#include <stdexcept>
#include <utility>

namespace proof {
namespace {

// The default history is full when frames begin to count. From there it matters little: with default
// settings, sequences of 24 and of 48 frames told as much for their time (variance x frames 12 and 10, each
// to a third), while rows with rare bright outliers need many sequences whatever their length.
constexpr uint32_t kFrames = 32, kWarmUp = 20;

Scenario make(std::string name, std::string help, float orbitDegrees = 0, std::string animation = {}) {
    return {.name = std::move(name),
            .help = std::move(help),
            .frames = kFrames,
            .warmUp = kWarmUp,
            .orbitDegrees = orbitDegrees,
            .animation = std::move(animation)};
}

}   // namespace

const std::vector<Scenario>& scenarios() {
    static const std::vector<Scenario> kScenarios = {
        make("static", "nothing moves"),
        make("camera", "the camera orbits its target by 1 degree a frame", 1),
        make("lights", "the scene's animation lights", 0, "lights"),
        make("switching", "the scene's animation switching", 0, "switching"),
        make("objects", "the scene's animation objects", 0, "objects"),
    };
    return kScenarios;
}

Scenario findScenario(const std::string& name) {
    std::string known;
    for (const Scenario& scenario : scenarios()) {
        if (scenario.name == name) return scenario;
        known += (known.empty() ? "" : ", ") + scenario.name;
    }
    throw std::runtime_error("'" + name + "' is no scenario, known: " + known);
}

}   // namespace proof
