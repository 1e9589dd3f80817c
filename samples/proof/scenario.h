// What happens while an estimator is watched.
#pragma once

#include <string>
#include <vector>

#include <common/frame_loop.h>

namespace proof {

struct Scenario {
    std::string name, help;
    uint32_t frames = 0;      // of a sequence, the first of which starts without history
    uint32_t warmUp = 0;      // of them, which fill the history and do not count
    float orbitDegrees = 0;   // the camera's, about its target, from frame to frame

    uint32_t counted() const { return frames - warmUp; }
    bool changes() const { return orbitDegrees != 0; }   // frames have pictures of their own
    samples::Sequence sequence(const samples::View& view, uint32_t seed) const;
};

const std::vector<Scenario>& scenarios();
// Throws std::runtime_error listing the known ones.
Scenario findScenario(const std::string& name);

}   // namespace proof
