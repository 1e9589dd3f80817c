// The stages of ReSTIR GI as the plan sees them. Reservoir buffers are 0 (A) and 1 (B). What they find is added to the
// pixel's own light, with the surfaces.
#pragma once

#include <restir/session.h>

namespace restir::gi {

PassInfo path() noexcept;   // the candidates' pass with nothing to keep: all that they find is added
PassInfo candidates(uint32_t target) noexcept;
PassInfo temporal(uint32_t history, uint32_t target) noexcept;   // rewrites its own pixel of `target`
PassInfo spatial(uint32_t source, uint32_t target, uint32_t index, bool shades) noexcept;
// The two halves of a spatial pass between partners; both belong to pass `index`.
PassInfo pairTargets(uint32_t source, uint32_t index) noexcept;
PassInfo pairSpatial(uint32_t source, uint32_t target, uint32_t index, bool shades) noexcept;
PassInfo boiling(uint32_t buffer) noexcept;
PassInfo shade(uint32_t buffer) noexcept;
PassInfo fill() noexcept;   // with a checkerboard: the pixels that have no reservoirs

}   // namespace restir::gi
