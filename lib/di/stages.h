// The stages of ReSTIR DI as the plan sees them. Reservoir buffers are 0 (A) and 1 (B).
#pragma once

#include <restir/session.h>

namespace restir::di {

PassInfo candidates(uint32_t target) noexcept;
PassInfo temporal(uint32_t history, uint32_t target) noexcept;   // rewrites its own pixel of `target`
PassInfo spatiotemporal(uint32_t history, uint32_t target, bool shades) noexcept;   // likewise
PassInfo boiling(uint32_t buffer) noexcept;   // cuts outliers back
PassInfo spatial(uint32_t source, uint32_t target, uint32_t index, bool shades) noexcept;
// The two halves of a spatial pass between partners; both belong to pass `index`.
PassInfo pairTargets(uint32_t source, uint32_t index) noexcept;
PassInfo pairSpatial(uint32_t source, uint32_t target, uint32_t index, bool shades) noexcept;
PassInfo shade(uint32_t buffer) noexcept;
PassInfo fill(uint32_t buffer) noexcept;   // with a checkerboard: the pixels that `buffer` has nothing for
PassInfo gradient(uint32_t history, uint32_t current) noexcept;   // before spatial reuse overwrites `history`
PassInfo nextEvent() noexcept;
PassInfo off() noexcept;   // writes the outputs without direct light
PassInfo debug(uint32_t buffer, uint32_t lastSpatial) noexcept;   // shows `buffer`, and whom that spatial pass asked

}   // namespace restir::di
