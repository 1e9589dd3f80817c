#pragma once

#include <frame/session_impl.h>

namespace restir {

// Writes set 0 of the frame's slot. `surfaces` is the surface buffer this frame fills.
void writeDescriptors(const Session::Impl& session, const FrameInput& frame, uint32_t surfaces,
                      VkBuffer previousLights) noexcept;

}   // namespace restir
