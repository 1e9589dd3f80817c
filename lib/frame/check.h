// What a frame must hold before anything is recorded.
#pragma once

#include <frame/session_impl.h>

namespace restir {

// The message sink names the first field that is wrong, and its value.
Status checkFrame(const Session::Impl& session, const FrameInput& frame, const Settings& settings) noexcept;

// Of a frame, what its passes depend on; checkFrame's part.
Status checkSettings(const Session::Impl& session, VkExtent2D extent, const Settings& settings) noexcept;

// Whether the last frame can be reused: recorded, not cut, its lights and its Bvh one generation old at
// most, and its samples killed or not as the settings have it now: weights that ignore visibility are wrong for samples
// that depend on it, and the other way round.
bool historyUsable(const Session::Impl& session, const FrameInput& frame, const Settings& settings) noexcept;

bool giHistoryUsable(const Session::Impl& session, const FrameInput& frame, const Settings& settings) noexcept;

}   // namespace restir
