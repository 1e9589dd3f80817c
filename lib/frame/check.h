// What a frame must hold before anything is recorded.
#pragma once

#include <frame/session_impl.h>

namespace restir {

// The message sink names the first field that is wrong, and its value.
Status checkFrame(const Session::Impl& session, const FrameInput& frame, const Settings& settings) noexcept;

// Whether the last frame can be reused: recorded, not cut, and its lights one generation old at most.
bool historyUsable(const Session::Impl& session, const FrameInput& frame) noexcept;

}   // namespace restir
