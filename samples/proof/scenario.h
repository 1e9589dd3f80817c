// What happens while an estimator is watched.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace proof {

struct Scenario {
    std::string name, help;
    uint32_t frames = 0;          // of a sequence, the first of which starts without history
    uint32_t warmUp = 0;          // of them, which fill the history and do not count
    float orbitDegrees = 0;       // the camera's, about its target, from frame to frame
    std::string animation = {};   // of the scene; empty: it stands still

    uint32_t counted() const { return frames - warmUp; }
    // Frames have pictures of their own.
    bool changes() const { return orbitDegrees != 0 || !animation.empty(); }
};

const std::vector<Scenario>& scenarios();
// Throws std::runtime_error listing the known ones.
Scenario findScenario(const std::string& name);

}   // namespace proof
