// Fills cells with sequences.
#pragma once

#include <functional>
#include <optional>

#include "proof/prover.h"
#include "proof/verdict.h"

namespace proof {

// When a cell has enough: whichever comes first of those that are set.
struct Limits {
    size_t sequences = 0;
    double halfWidth = 0;   // of the 95 % confidence interval of its luminance, relative
    double minutes = 0;     // for all cells together
};

struct ReferenceQuality {
    size_t sequences = 64;
    uint32_t paths = 256;   // per pixel and sequence; shared out over its frames where they differ
};

// What of an older file may be gone on with.
enum class Stale { Refuse, Keep, Redo };

struct Plan {
    std::string scene;
    VkExtent2D extent{64, 64};
    std::vector<Scenario> scenarios;
    std::vector<Row> rows;
    Limits limits;
    ReferenceQuality reference;
    Stale stale = Stale::Refuse;
    size_t batch = 4;   // sequences of a cell before the next has its turn; even
};

// Throws std::runtime_error for a plan that makes no sense, before anything is rendered.
void check(const Plan& plan);

// Adds what `plan` asks for to `file` and saves it after batches, references first. Cells take turns.
// `say` gets lines of progress. A cell of another commit or with other settings is refused, gone on with, or
// begun anew.
void run(const Plan& plan, ProofFile& file, Prover& prover,
         const std::function<void(const std::string&)>& say);

// Sequences in all that narrow the 95 % confidence interval of a cell's luminance to so much; infinitely many
// where the reference alone is less certain. The error of a mean falls with the root of their number.
double sequencesFor(double halfWidth, const SeedStatistics& cell, const SeedStatistics& reference);

}   // namespace proof
