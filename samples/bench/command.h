// restir-bench's subcommands: each adds itself to the program's command line.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "common/scene_options.h"
#include "proof/cell.h"

namespace bench {

void addCost(CLI::App& app);     // what an estimator costs
void addError(CLI::App& app);    // what it buys
void addBias(CLI::App& app);     // what its mean converges to
void addTable(CLI::App& app);    // what addBias() found, as text
void addPlot(CLI::App& app);     // and as pictures
void addLights(CLI::App& app);   // what lights that all move cost
void addRays(CLI::App& app);     // how fast rays alone are

// --row NAME='settings', repeatable.
void addRows(CLI::App& app, std::vector<std::string>& texts);

// Warnings go to stderr.
samples::SceneData load(const samples::SceneOptions& scene);

}   // namespace bench
