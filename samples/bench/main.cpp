// restir-bench: what ReSTIR costs, what it buys, and whether it is right.
#include <cstdio>
#include <stdexcept>

#include "bench/command.h"

namespace bench {

void addRows(CLI::App& app, std::vector<std::string>& texts) {
    app.add_option("--row", texts, "an estimator, as in --row quick='weights=off radius=6'; may be repeated")
        ->type_name("NAME=SETTINGS")
        ->allow_extra_args(false);
}

samples::SceneData load(const samples::SceneOptions& scene) {
    std::vector<std::string> warnings;
    samples::SceneData data = samples::load(scene, warnings);
    for (const std::string& warning : warnings) std::fprintf(stderr, "warning: %s\n", warning.c_str());
    return data;
}

}   // namespace bench

int main(int argc, char** argv) {
    CLI::App app("Measures what ReSTIR costs, what it buys, and whether it is right.", "restir-bench");
    app.require_subcommand(1);
    bench::addCost(app);
    bench::addError(app);
    bench::addBias(app);
    bench::addTable(app);
    bench::addPlot(app);
    bench::addLights(app);
    bench::addRays(app);
    try {
        app.parse(argc, argv);   // runs the subcommand
    } catch (const CLI::Success& answer) {
        return app.exit(answer);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "restir-bench: %s\n", error.what());
        return 1;
    }
    return 0;
}
