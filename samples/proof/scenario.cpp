#include "proof/scenario.h"

#include <stdexcept>

namespace proof {
namespace {

// The default history is full when frames begin to count. From there it matters little: with default
// settings, sequences of 24 and of 48 frames told as much for their time (variance x frames 12 and 10, each
// to a third), while rows with rare bright outliers need many sequences whatever their length.
constexpr uint32_t kFrames = 32, kWarmUp = 20;

}   // namespace

const std::vector<Scenario>& scenarios() {
    static const std::vector<Scenario> kScenarios = {
        {.name = "static", .help = "nothing moves", .frames = kFrames, .warmUp = kWarmUp},
        {.name = "camera",
         .help = "the camera orbits its target by 1 degree a frame",
         .frames = kFrames,
         .warmUp = kWarmUp,
         .orbitDegrees = 1},
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

samples::Sequence Scenario::sequence(const samples::View& view, uint32_t seed) const {
    return {.view = view, .frames = frames, .seed = seed, .orbitDegrees = orbitDegrees};
}

}   // namespace proof
