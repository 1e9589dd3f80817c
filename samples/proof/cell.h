// A cell of a bias table: one estimator in one scenario, and all that is known of it.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <restir/settings.h>
#include <vulkan/vulkan_core.h>

#include "proof/block_statistics.h"
#include "proof/measures.h"
#include "proof/scenario.h"

namespace proof {

// An estimator by its name and settings (samples::parseSettings()).
struct Row {
    std::string name, settings;
};
// "NAME=settings", which change `base`. Throws std::runtime_error.
Row parseRow(const std::string& text, const restir::Settings& base = {});
// The rows of a table that restir-bench knows by name: "weights", "presets", "options", "indirect". Throws
// std::runtime_error.
std::vector<Row> namedRows(const std::string& table);

// What light a picture shows.
struct Transport {
    uint32_t bounces = 1;
    bool direct = true;   // light scattered once, too

    std::string name() const;   // direct light's is empty
    bool operator==(const Transport&) const = default;
};
Transport transportOf(const restir::Settings& settings);

// What a cell's or a reference's statistics depend on.
struct Subject {
    std::string scene;
    uint32_t width = 0, height = 0;
    std::string scenario;
    uint32_t frames = 0, warmUp = 0;
    std::string transport;       // its name
    std::string row, settings;   // of a reference: empty, and its paths per picture

    bool samePlace(const Subject& other) const;   // all but frames and settings: what names it in a file
    bool operator==(const Subject&) const = default;
    std::string title() const;           // "ROW / SCENARIO"
    uint32_t seed(size_t index) const;   // of sequence `index`, this subject's own
};
Subject subjectOf(const std::string& scene, VkExtent2D extent, const Scenario& scenario, const Row& row);

// What cells are held against: the reference path tracer, as independent sequences of its own.
struct Reference {
    Subject subject;
    std::string commit;
    SeedStatistics mean, last;   // over sequences: of the frames that count, of the last frame
    samples::FloatImage meanPicture, lastPicture;
    samples::FloatImage lastVariance;   // of one sequence's last frame; luminance, in each channel

    size_t sequences() const { return mean.pictures(); }
    // What the noise of lastPicture adds to relativeError() against it.
    double noise() const;
    // Two independent sequences.
    void add(const Take& first, const Take& second);
};

struct Cell {
    Subject subject;
    std::string commit;
    SeedStatistics mean, last;   // as above
    double errors = 0;           // sum of the last frames' relativeError()
    NoiseCorrelation noise;
    double seconds = 0;                                   // of all sequences
    std::vector<std::pair<size_t, double>> convergence;   // sequences, blockError() of their mean
    samples::FloatImage meanPicture, onePicture;          // over sequences; the last frame of one

    size_t sequences() const { return mean.pictures(); }
    double relativeError(const Reference& reference) const;   // of a frame
    Agreement agreement(const Reference& reference) const {
        return compare(mean, referenceFromSeeds(reference.mean));
    }
    // Two independent sequences.
    void add(const Take& first, const Take& second, const Reference& reference);
};

// Root of the mean square, over blocks, of mean / reference - 1.
double blockError(const SeedStatistics& mean, const ReferenceBlocks& reference);

}   // namespace proof
