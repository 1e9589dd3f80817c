// Keys and mouse, where the panels do not want them.
#pragma once

#include "viewer/stage.h"
#include "viewer/state.h"
#include "viewer/window.h"

namespace viewer {

// Between Overlay::begin() and record().
void applyInput(State& state, const Stage& stage, Window& window);

// What the keys do, as lines of a help text.
const char* keysText();

}   // namespace viewer
