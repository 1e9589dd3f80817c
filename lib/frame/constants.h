// FrameInput and Settings as the shaders read them.
#pragma once

#include <frame/session_impl.h>

namespace restir {

gpu::RsView makeView(const Camera& camera, VkExtent2D extent) noexcept;
gpu::RsFrame makeConstants(const Session::Impl& session, const FrameInput& frame, const Settings& settings,
                           bool history, bool giHistory) noexcept;

}   // namespace restir
