// GPU time of the SDK's passes over that of one dispatch that traces the same rays again.
#include <cstdio>
#include <memory>

#include "bench/workbench.h"
#include "common/ray_replay.h"

namespace bench {
namespace {

constexpr uint32_t kReplays = 5;

struct Options {
    SceneOptions scene;
    uint32_t rounds = 3;
};

void printRow(Workbench& bench, Contender& row, const Options& options) {
    const auto& stats = row.renderer().stats();
    const double replay =
        samples::replayRays(bench.device(), bench.scene(), row.renderer().session().rayLog(),
                            stats.counters.loggedRays, kReplays);
    const double pixels = double(options.scene.extent.width) * options.scene.extent.height;
    std::printf("%-20s %10.2f %10.0f %8.2f %9.1f %12.2f %7.2f\n", row.name().c_str(), row.milliseconds(),
                row.milliseconds() * 1e6 / pixels, row.raysPerPixel(), row.bytesPerPixel(), replay,
                row.milliseconds() / replay);
    if (stats.counters.rejectedWeights > 0)
        std::printf("  %u weights rejected\n", stats.counters.rejectedWeights);
}

void run(const Options& options) {
    Workbench bench(options.scene);
    for (uint32_t round = 1; round <= options.rounds; ++round)
        for (Contender& row : bench.contenders()) row.render(round, options.scene.frames);
    if (bench.contenders().size() == 1) {
        for (const auto& pass : bench.contenders()[0].renderer().stats().passes)
            std::printf("%-20s %10.2f ms\n", pass.name.c_str(), medianOf(pass));
    }
    std::printf("%-20s %10s %10s %8s %9s %12s %7s\n", "", "GPU ms", "ns/pixel", "rays/px", "bytes/px",
                "rays alone", "ratio");
    for (Contender& row : bench.contenders()) printRow(bench, row, options);
}

}   // namespace

void addCost(CLI::App& app) {
    const auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand(
        "cost",
        "GPU time of a frame, its rays and memory, and the time over that of tracing the same rays alone.");
    addScene(*command, options->scene);
    command->add_option("--rounds", options->rounds, "sequences of each row, in turns; the best counts (3)")
        ->check(CLI::Range(1, 1000))
        ->type_name("N");
    command->callback([options] { run(*options); });
}

}   // namespace bench
