#pragma once

#include "common/image_io.h"
#include "render/options.h"
#include "render/report.h"

namespace render {

struct Outcome {
    samples::FloatImage image;
    Report report;
};

// Loads the scene and renders it. Throws std::runtime_error.
Outcome render(const Options& options);

// All of the files that were asked for, or none and a std::runtime_error.
void writeFiles(const Options& options, const Outcome& outcome);

}   // namespace render
