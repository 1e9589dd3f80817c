#pragma once

#include <span>
#include <vector>

#include <restir/shared/lights.h>

namespace restir {

// Alias table of `weights` (finite, >= 0; fewer than 2^32): drawing a column uniformly and keeping it below its
// threshold of 2^32, else taking its alias, has nearly the probability weights[i] / sum. Every weight > 0 can be drawn,
// a weight of 0 never is. Empty if every weight is 0. Vose 1991, O(n), deterministic.
std::vector<gpu::RsAliasEntry> makeAliasTable(std::span<const double> weights);

// What drawing from that table does exactly, thresholds rounded as they are.
std::vector<double> aliasProbabilities(std::span<const gpu::RsAliasEntry> table);

}   // namespace restir
