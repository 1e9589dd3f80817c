// What every target borrows from a host on the null device.
#pragma once

#include <restir/restir.h>

#include "fuzz/null_device.h"

namespace fuzz {

inline constexpr uint32_t kFrames = 2, kTextures = 3;

const restir::Context& context();
const restir::Scene& scene();

}   // namespace fuzz
