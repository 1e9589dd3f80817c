#include <cstdio>
#include <memory>
#include <stdexcept>

#include "bench/command.h"
#include "proof/summary.h"

namespace bench {
namespace {

struct Options {
    std::string json;
    double halfWidthPercent = 0.5;
    bool details = false, byScene = false;
};

}   // namespace

void addTable(CLI::App& app) {
    const auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand("table", "Prints what `bias` found as a table in Markdown.");
    command->add_option("file", options->json, "of `bias`")
        ->required()
        ->check(CLI::ExistingFile)
        ->type_name("FILE.json");
    command
        ->add_option("--half-width", options->halfWidthPercent,
                     "that an unbiased row's interval must be within (0.5)")
        ->type_name("PERCENT");
    command->add_flag(
        "--details", options->details,
        "also channels, the last frame alone, error, temporal correlation and time of each cell");
    command->add_flag("--scenes", options->byScene, "a table of its scenes for each row");
    command->callback([options] {
        const proof::ProofFile file(options->json, false);
        const proof::Table table =
            proof::tabulate(file, options->halfWidthPercent / 100,
                            options->byScene ? proof::Lines::Scenes : proof::Lines::Rows);
        if (table.summaries.empty())
            throw std::runtime_error(options->json + ": no cell has enough sequences yet");
        std::printf("%s", proof::biasTable(table).c_str());
        if (options->details) std::printf("\n%s", proof::detailTable(table).c_str());
    });
}

}   // namespace bench
