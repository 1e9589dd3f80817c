#include "proof/cell.h"

#include <cmath>
#include <stdexcept>

#include <common/setting_options.h>

namespace proof {
namespace {

// `mean` of `count` pictures, of which `image` is the latest.
void average(samples::FloatImage& mean, const samples::FloatImage& image, size_t count) {
    if (count == 1) {
        mean = image;
        return;
    }
    for (size_t i = 0; i < mean.rgb.size(); ++i) mean.rgb[i] += (image.rgb[i] - mean.rgb[i]) / float(count);
}

bool isPowerOfTwo(size_t n) { return (n & (n - 1)) == 0; }

}   // namespace

Row parseRow(const std::string& text, const restir::Settings& base) {
    const size_t equals = text.find('=');
    const size_t space = text.find(' ');
    if (equals == std::string::npos || equals == 0)
        throw std::runtime_error("'" + text + "' is not NAME=settings");
    if (space < equals) throw std::runtime_error("'" + text + "': a row's name has no spaces");
    // Read and written again, so that one estimator has one text.
    return {text.substr(0, equals),
            samples::settingsText(samples::parseSettings(text.substr(equals + 1), base))};
}

std::vector<Row> namedRows(const std::string& table) {
    std::vector<Row> rows;
    if (table == "weights") {
        // Short histories and near neighbours: with the defaults' outliers Off, Basic and Balance want days.
        const restir::Settings base{.di = {.maxHistory = 4, .radius = 16}};
        for (const std::string weights : {"off", "basic", "balance", "pairwise"})
            for (const std::string visibility : {"none", "cached", "traced"})
                rows.push_back(parseRow(
                    weights + "-" + visibility + "=weights=" + weights + " visibility=" + visibility, base));
    } else if (table == "presets") {
        for (const std::string preset : {"fast", "balanced", "quality", "unbiased"})
            rows.push_back(parseRow(preset + "=preset=" + preset));
    } else if (table == "options") {
        for (const char* row :
             {"plain=weights=plain", "fused=fused=on", "paired=paired-neighbours=on",
              "rounds=initial-samples=4 candidates=4", "two-passes=spatial-passes=2",
              "no-average=average=off", "no-bsdf=bsdf-candidates=0", "no-temporal=temporal=off",
              "no-spatial=spatial-passes=0", "permuted=permute-history=on", "checkerboard=checkerboard=on",
              "boiling=boiling-filter=0.5", "nee=mode=nee"})
            rows.push_back(parseRow(row));
    } else if (table == "indirect") {
        for (const char* row :
             {"gi=mode=gi", "gi-pairwise-traced=mode=gi-only",
              "gi-paired=mode=gi-only gi-paired-neighbours=on",
              "gi-pairwise-cached=mode=gi-only visibility=cached",
              "gi-balance-traced=mode=gi-only gi-weights=balance",
              "gi-basic-traced=mode=gi-only gi-weights=basic",
              "gi-off-cached=mode=gi-only gi-weights=off visibility=cached", "pt-only=mode=pt-only"})
            rows.push_back(parseRow(row, {.di = {.maxHistory = 4, .radius = 16}}));
    } else {
        throw std::runtime_error("'" + table + "' is no table, known: weights presets options indirect");
    }
    return rows;
}

std::string Transport::name() const {
    if (bounces == 1) return "";
    return (direct ? "light of " : "indirect light of ") + std::to_string(bounces) + " bounces";
}

Transport transportOf(const restir::Settings& settings) {
    if (settings.gi.mode == restir::IndirectMode::Off) return {};
    return {.bounces = settings.gi.bounces, .direct = settings.di.mode != restir::DirectMode::Off};
}

bool Subject::samePlace(const Subject& other) const {
    return scene == other.scene && width == other.width && height == other.height &&
           scenario == other.scenario && transport == other.transport && row == other.row;
}

std::string Subject::title() const {
    const std::string reference = transport.empty() ? "reference" : "reference of " + transport;
    return (row.empty() ? reference : row) + " / " + scenario;
}

uint32_t Subject::seed(size_t index) const {
    uint32_t hash = 2166136261u;   // FNV-1a of what names the subject
    for (const char c : scene + '/' + scenario + '/' + transport + row)
        hash = (hash ^ static_cast<uint8_t>(c)) * 16777619u;
    return hash + static_cast<uint32_t>(index);
}

Subject subjectOf(const std::string& scene, VkExtent2D extent, const Scenario& scenario, const Row& row) {
    return {.scene = scene,
            .width = extent.width,
            .height = extent.height,
            .scenario = scenario.name,
            .frames = scenario.frames,
            .warmUp = scenario.warmUp,
            .transport = transportOf(samples::parseSettings(row.settings)).name(),
            .row = row.name,
            .settings = row.settings};
}

double Reference::noise() const {
    // As if the variance were a squared error.
    samples::FloatImage picture = lastPicture;
    for (size_t i = 0; i < picture.rgb.size(); ++i) picture.rgb[i] += std::sqrt(lastVariance.rgb[i]);
    return sequences() > 0 ? relativeError(picture, lastPicture) / double(sequences()) : 0;
}

void Reference::add(const Take& first, const Take& second) {
    for (const Take* take : {&first, &second}) {
        mean.add(take->mean);
        last.add(take->end.last);
        average(meanPicture, take->mean, sequences());
        average(lastPicture, take->end.last, sequences());
    }
    samples::FloatImage variance = first.end.last;
    for (size_t i = 0; i < variance.rgb.size() / 3; ++i) {
        const double difference = luminance(first.end.last, i) - luminance(second.end.last, i);
        for (size_t c = 0; c < 3; ++c) variance.rgb[3 * i + c] = float(0.5 * difference * difference);
    }
    average(lastVariance, variance, sequences() / 2);
}

double Cell::relativeError(const Reference& reference) const {
    return sequences() > 0 ? errors / double(sequences()) - reference.noise() : 0;
}

void Cell::add(const Take& first, const Take& second, const Reference& reference) {
    for (const Take* take : {&first, &second}) {
        mean.add(take->mean);
        last.add(take->end.last);
        average(meanPicture, take->mean, sequences());
        errors += proof::relativeError(take->end.last, reference.lastPicture);
    }
    onePicture = second.end.last;
    noise.add(first.end, second.end, reference.lastPicture);
    if (isPowerOfTwo(sequences()))
        convergence.emplace_back(sequences(), blockError(mean, referenceFromSeeds(reference.mean)));
}

double blockError(const SeedStatistics& mean, const ReferenceBlocks& reference) {
    double sum = 0;
    size_t counted = 0;
    for (size_t i = 0; i < mean.blocks(); ++i) {
        if (reference.mean[i] <= 0) continue;
        const double error = mean.blockMean(i) / reference.mean[i] - 1;
        sum += error * error;
        ++counted;
    }
    return counted > 0 ? std::sqrt(sum / double(counted)) : 0;
}

}   // namespace proof
