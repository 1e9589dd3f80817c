// The order of the stages: everything record() will dispatch, known before it does, without a GPU.
#pragma once

#include <vector>

#include <restir/session.h>

namespace restir {

struct PlanInput {
    VkExtent2D extent = {0, 0};
    bool history = false;     // the previous frame's surfaces and reservoirs are valid
    uint32_t historyIn = 0;   // reservoir buffer (0 or 1) that holds them
    bool gradient = false;    // Output::gradient is asked for
    bool giHistory = false;   // as `history` and `historyIn`, of indirect light
    uint32_t giHistoryIn = 0;
    bool indirectLobes = false;   // Output::indirectDiffuse or indirectSpecular
};

struct Plan {
    std::vector<PassInfo> passes;
    uint32_t historyOut = 0, giHistoryOut = 0;   // reservoir buffers that hold this frame's results
};

// What frames of this extent light one pixel of (restir/di/field.glsl). A column alone, or for blocks a row, has no others to be
// filled from.
enum class Cell : uint8_t { Pixel, Pair, Block };
Cell cellOf(VkExtent2D extent, const DiSettings& settings) noexcept;
Cell cellOf(VkExtent2D extent, const GiSettings& settings) noexcept;

// Whether gi.candidates shades a part of what it found: unless outliers are cut back, which it has before the filter.
bool showsOwnPath(const GiSettings& settings) noexcept;

Plan makePlan(const PlanInput& input, const Settings& settings);

// Whether `pass` must wait for something since the last barrier. `written` and `read` hold a bit per Resource
// used since then.
struct Hazards {
    uint32_t read = 0, written = 0;

    bool conflicts(const PassInfo& pass) const noexcept;
    void add(const PassInfo& pass) noexcept;
};

}   // namespace restir
