#pragma once

#include <restir/session.h>

namespace restir::surface {

PassInfo pack() noexcept;   // the host's G-buffer to packed surfaces

}   // namespace restir::surface
