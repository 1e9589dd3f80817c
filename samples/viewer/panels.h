// The windows over the picture.
#pragma once

#include "viewer/facts.h"
#include "viewer/state.h"

namespace viewer {

// Between Overlay::begin() and record().
void drawPanels(State& state, const Facts& facts);

// Their parts.
void drawSettings(State& state);
void drawPicture(State& state, const Facts& facts);
void drawScene(State& state, const Facts& facts);
void drawMemory(const Facts& facts);
void drawMeasures(const Facts& facts);
void drawLegend(const State& state);

}   // namespace viewer
