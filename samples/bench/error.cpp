// The error of single frames over independent seeds, and what it is worth in time. The reference is the mean
// of independent frames without temporal reuse, an unbiased estimator (tests/image hold it to other
// renderers).
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <stdexcept>

#include "bench/workbench.h"
#include "common/setting_options.h"

namespace bench {
namespace {

using samples::FloatImage;

struct Options {
    SceneOptions scene;
    uint32_t seeds = 8, referenceFrames = 128;
    std::string reference;
};

constexpr uint32_t kReferenceSeed = 1000;   // and on: apart from those measured

FloatImage makeReference(Workbench& bench, const Options& options) {
    restir::Settings settings = bench.contenders()[0].settings();
    settings.di.temporal = false;
    settings.di.weights = restir::Weights::Pairwise;
    settings.di.visibility = restir::VisibilityReuse::Traced;
    samples::reuseAlike(settings);
    Contender& source = bench.add("reference", settings);
    FloatImage sum = source.render(kReferenceSeed, 1).last;
    for (uint32_t i = 1; i < options.referenceFrames; ++i) {
        const FloatImage one = source.render(kReferenceSeed + i, 1).last;
        for (size_t k = 0; k < sum.rgb.size(); ++k) sum.rgb[k] += one.rgb[k];
    }
    for (float& v : sum.rgb) v /= float(options.referenceFrames);
    bench.contenders().pop_back();
    return sum;
}

FloatImage referenceOf(Workbench& bench, const Options& options) {
    const std::string& path = options.reference;
    if (!path.empty() && std::filesystem::exists(path)) {
        FloatImage image = samples::readExr(path);
        if (image.width != options.scene.extent.width || image.height != options.scene.extent.height)
            throw std::runtime_error(path + ": is " + std::to_string(image.width) + "x" +
                                     std::to_string(image.height));
        return image;
    }
    std::fprintf(stderr, "reference: %u frames\n", options.referenceFrames);
    FloatImage image = makeReference(bench, options);
    if (!path.empty()) samples::writeExr(path, image);
    return image;
}

// Next-event samples whose passes take as long.
uint32_t matchingSamples(Workbench& bench, restir::Settings settings, double milliseconds) {
    double times[2];
    for (uint32_t i = 0; i < 2; ++i) {
        settings.di.lightCandidates = 4 + 4 * i;
        Contender& trial = bench.add("trial", settings);
        for (uint32_t seed = 0; seed < 3; ++seed) trial.render(seed, 3);
        times[i] = trial.milliseconds();
        bench.contenders().pop_back();
    }
    const double perSample = (times[1] - times[0]) / 4;
    return std::max(1u, uint32_t(std::lround(4 + (milliseconds - times[0]) / perSample)));
}

// Plain next-event estimation in the first row's time, and the first row's candidates alone; with indirect
// light one plain path a pixel, whose error falls with the time spent on it.
void addBaselines(Workbench& bench) {
    Contender& first = bench.contenders()[0];
    const restir::Settings settings = first.settings();
    if (settings.gi.mode != restir::IndirectMode::Off) {
        restir::Settings plain = settings;
        plain.gi.mode = restir::IndirectMode::Path;
        if (plain.di.mode == restir::DirectMode::Restir) {
            plain.di.mode = restir::DirectMode::NextEvent;
            plain.di.lightCandidates = 1;
        }
        bench.add(samples::modeText(plain), plain);
        return;
    }
    if (settings.di.mode == restir::DirectMode::NextEvent) return;
    restir::Settings ris = settings;
    ris.di.temporal = false;
    ris.di.spatialPasses = 0;
    restir::Settings nee;
    nee.di.mode = restir::DirectMode::NextEvent;
    nee.di.lightCandidates = matchingSamples(bench, nee, first.milliseconds());
    bench.add("ris", ris);
    bench.add("nee x " + std::to_string(nee.di.lightCandidates), nee);
}

bool hasHistory(const restir::Settings& settings) {
    return (settings.di.mode == restir::DirectMode::Restir && settings.di.temporal) ||
           (settings.gi.mode == restir::IndirectMode::Restir && settings.gi.temporal);
}

// Of the pixels; what the rest of them do, a few sequences do not tell.
constexpr double kKept = 0.99;

struct Result {
    double error = 0, trimmed = 0;
    proof::NoiseCorrelation noise;
};

void print(Workbench& bench, const std::vector<Result>& results, uint32_t seeds) {
    std::printf("%-20s %10s %8s %9s %10s %10s %12s %22s\n", "", "GPU ms", "rays/px", "bytes/px", "error",
                "of 99 %", "correlation", "error x time, 1st = 1");
    double first = 0;
    for (size_t i = 0; i < results.size(); ++i) {
        Contender& row = bench.contenders()[i];
        const double error = results[i].error / seeds, product = error * row.milliseconds();
        if (i == 0) first = product;
        std::printf("%-20s %10.2f %8.2f %9.1f %10.5f %10.5f %12.3f %22.3f\n", row.name().c_str(), row.milliseconds(),
                    row.raysPerPixel(), row.bytesPerPixel(), error, results[i].trimmed / seeds,
                    results[i].noise.value(),
                    product / first);
    }
}

void run(const Options& options) {
    Workbench bench(options.scene);
    const FloatImage reference = referenceOf(bench, options);
    bench.contenders()[0].render(0, options.scene.frames);   // its time
    addBaselines(bench);
    std::vector<Result> results(bench.contenders().size());
    // Seed by seed: a machine that slows down slows all rows.
    for (uint32_t seed = 1; seed <= options.seeds; seed += 2) {
        for (size_t i = 0; i < results.size(); ++i) {
            Contender& row = bench.contenders()[i];
            const uint32_t frames = hasHistory(row.settings()) ? options.scene.frames : 2;
            const proof::FramePair a = row.render(seed, frames), b = row.render(seed + 1, frames);
            results[i].error +=
                proof::relativeError(a.last, reference) + proof::relativeError(b.last, reference);
            for (const FloatImage* last : {&a.last, &b.last})
                results[i].trimmed += proof::trimmedError(*last, reference, kKept);
            results[i].noise.add(a, b, reference);
        }
        std::fprintf(stderr, "%u of %u seeds\n", seed + 1, options.seeds);
    }
    print(bench, results, options.seeds);
}

}   // namespace

void addError(CLI::App& app) {
    const auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand("error",
                                           "Error mean((I - R)^2 / (R^2 + 0.01 mean(R)^2)) of a frame, for "
                                           "each row, and of the 99 % of pixels with the least error, for its candidates alone (ris) and for "
                                           "next-event estimation (nee) with as many samples as fit the "
                                           "first row's time, or with indirect light for one plain path a "
                                           "pixel; and how much of a frame's noise the "
                                           "next one repeats.");
    addScene(*command, options->scene);
    command->add_option("--seeds", options->seeds, "independent sequences of each row, an even number (8)")
        ->check(CLI::Range(2, 10000))
        ->type_name("N");
    command->add_option("--reference", options->reference, "the reference picture; made if it is missing")
        ->type_name("FILE.exr");
    command->add_option("--reference-frames", options->referenceFrames, "averaged into a reference (128)")
        ->check(CLI::Range(1, 100000))
        ->type_name("N");
    command->callback([options] {
        if (options->seeds % 2 == 1)
            throw std::runtime_error("--seeds: an even number, sequences go in pairs");
        run(*options);
    });
}

}   // namespace bench
