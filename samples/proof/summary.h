// A bias table: each scene's rows by its scenarios, or a row's scenes.
#pragma once

#include <map>

#include "proof/verdict.h"

namespace proof {

struct Entry {
    const Cell* cell = nullptr;
    const Reference* reference = nullptr;
    Judgement judgement;
};

struct SummaryRow {
    std::string name, settings;                    // the former a row's or a scene's
    std::map<std::string, Entry> entries;          // by scenario
    double worstZ = 0;                             // of all its hypotheses
    double meanSquare = 0, meanSquareSpread = 0;   // of the z of all its blocks
    Verdict verdict = Verdict::Open;               // the worst of its cells'
};

struct Summary {
    std::string title;   // scene or row, and size
    std::vector<std::string> scenarios;
    std::vector<SummaryRow> rows;
};

struct Table {
    std::vector<Summary> summaries;
    double hypotheses = 0;
    double zBound = 0;      // the largest of its cells': fewer sequences, wider tails
    double halfWidth = 0;   // asked of an unbiased one
    std::string commits;    // that made it
};
enum class Lines { Rows, Scenes };   // what the lines of a summary are
// Cells with less than kLeastSequences are left out. Borrows `file`.
Table tabulate(const ProofFile& file, double halfWidth, Lines lines = Lines::Rows);

// Markdown.
std::string biasTable(const Table& table);
std::string detailTable(const Table& table);

}   // namespace proof
