// What `bias` found as pictures: convergence, where the bias is, and what the frames look like.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <stdexcept>

#include "bench/chart.h"
#include "bench/command.h"
#include "proof/proof_file.h"

namespace bench {
namespace {

using proof::Cell;
using proof::Reference;
using samples::FloatImage;

constexpr uint32_t kLeastSide = 256;   // of a written picture: smaller ones are enlarged

std::string nameOf(const proof::Subject& subject) {
    std::string name =
        subject.scene + "-" + subject.scenario + (subject.row.empty() ? "" : "-" + subject.row);
    for (char& c : name)
        if (c == ':' || c == '/' || c == '?' || c == '&' || c == '=' || c == '\\') c = '_';
    return name;
}

void writeText(const std::string& path, const std::string& text) {
    std::ofstream file(path, std::ios::binary);
    file << text;
    file.close();
    if (!file) throw std::runtime_error(path + ": cannot be written");
}

FloatImage enlarge(const FloatImage& image) {
    const uint32_t factor = std::max(1u, kLeastSide / std::max(1u, std::min(image.width, image.height)));
    FloatImage large{image.width * factor, image.height * factor, {}};
    large.rgb.reserve(image.rgb.size() * factor * factor);
    for (uint32_t y = 0; y < large.height; ++y)
        for (uint32_t x = 0; x < large.width; ++x)
            for (size_t c = 0; c < 3; ++c)
                large.rgb.push_back(image.rgb[(size_t{y / factor} * image.width + x / factor) * 3 + c]);
    return large;
}

FloatImage besideOneAnother(const std::vector<const FloatImage*>& images) {
    FloatImage row{0, images[0]->height, {}};
    for (const FloatImage* image : images) row.width += image->width;
    for (uint32_t y = 0; y < row.height; ++y) {
        for (const FloatImage* image : images) {
            const auto begin = image->rgb.begin() + std::ptrdiff_t(size_t{y} * image->width * 3);
            row.rgb.insert(row.rgb.end(), begin, begin + std::ptrdiff_t(image->width) * 3);
        }
    }
    return row;
}

// Block by block: white where picture and reference agree, red where it is too bright and blue where too
// dark, full at `scale`.
FloatImage errorMap(const Cell& cell, const Reference& reference, double scale) {
    const uint32_t columns = cell.subject.width / proof::kBlock;
    FloatImage map{columns, cell.subject.height / proof::kBlock, {}};
    for (size_t i = 0; i < cell.mean.blocks(); ++i) {
        const double truth = reference.mean.blockMean(i);
        const double error = truth > 0 ? (cell.mean.blockMean(i) / truth - 1) / scale : 0;
        const auto fade = float(1 - std::min(std::abs(error), 1.0));
        map.rgb.insert(map.rgb.end(), {error < 0 ? fade : 1.0f, fade, error > 0 ? fade : 1.0f});
    }
    return map;
}

// The largest block error, rounded up to a number that can be read off.
double scaleOf(const Cell& cell, const Reference& reference) {
    double worst = 1e-4;
    for (size_t i = 0; i < cell.mean.blocks(); ++i) {
        const double truth = reference.mean.blockMean(i);
        if (truth > 0) worst = std::max(worst, std::abs(cell.mean.blockMean(i) / truth - 1));
    }
    for (double power = 1e-4;; power *= 10)
        for (double factor : {1.0, 2.0, 5.0})
            if (factor * power >= worst) return factor * power;
}

void plotCell(const Cell& cell, const Reference& reference, const std::string& directory) {
    const std::string path = directory + "/" + nameOf(cell.subject);
    const double scale = scaleOf(cell, reference);
    samples::writeColorsPng(path + "-error.png", enlarge(errorMap(cell, reference, scale)));
    const FloatImage side = besideOneAnother({&reference.meanPicture, &cell.meanPicture, &cell.onePicture});
    samples::writePng(path + "-side.png", enlarge(side));
    std::printf("%s-error.png: blocks, blue is %g %% too dark, red as much too bright\n", path.c_str(),
                100 * scale);
    std::printf("%s-side.png: reference, mean of %zu sequences, one frame\n", path.c_str(), cell.sequences());
}

// One chart for each scenario: an unbiased row falls with the dashed line, a biased one stops at its bias.
void plotConvergence(const proof::ProofFile& file, const std::string& directory) {
    std::map<std::string, Chart> charts;
    for (const Cell& cell : file.cells) {
        proof::Subject place = cell.subject;
        place.row.clear();
        Chart& chart = charts[nameOf(place)];
        chart.title = place.scene + ", " + place.scenario;
        chart.xName = "independent sequences";
        chart.yName = "error of the blocks' means";
        Line line{.name = cell.subject.row};
        for (const auto& [count, error] : cell.convergence) line.points.emplace_back(double(count), error);
        chart.lines.push_back(std::move(line));
    }
    for (auto& [name, chart] : charts) {
        Line root{.name = "1/sqrt(n)", .dashed = true};
        const auto& longest =
            *std::max_element(chart.lines.begin(), chart.lines.end(),
                              [](const Line& a, const Line& b) { return a.points.size() < b.points.size(); });
        for (const auto& [x, y] : longest.points)
            root.points.emplace_back(x, longest.points[0].second * std::sqrt(longest.points[0].first / x));
        chart.lines.push_back(std::move(root));
        const std::string path = directory + "/" + name + "-convergence.svg";
        writeText(path, toSvg(chart));
        std::printf("%s\n", path.c_str());
    }
}

struct Options {
    std::string json, directory;
};

void run(const Options& options) {
    const proof::ProofFile file(options.json);
    std::error_code error;
    std::filesystem::create_directories(options.directory, error);
    if (error) throw std::runtime_error(options.directory + ": cannot be made");
    plotConvergence(file, options.directory);
    for (const Cell& cell : file.cells)
        if (cell.sequences() > 0) plotCell(cell, file.referenceOf(cell), options.directory);
}

}   // namespace

void addPlot(CLI::App& app) {
    const auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand("plot",
                                           "Draws what `bias` found: a convergence chart (SVG) of each "
                                           "scenario; of each cell a map of its error and "
                                           "reference, mean and one frame beside one another (PNG).");
    command->add_option("file", options->json, "of `bias`")
        ->required()
        ->check(CLI::ExistingFile)
        ->type_name("FILE.json");
    command->add_option("--out", options->directory, "made if it is missing")->required()->type_name("DIR");
    command->callback([options] { run(*options); });
}

}   // namespace bench
