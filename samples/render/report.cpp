#include "render/report.h"

#include <algorithm>
#include <cstdio>

#include <nlohmann/json.hpp>

#ifdef _WIN32
#include <io.h>
#define RENDER_IS_TERMINAL() (_isatty(2) != 0)
#else
#include <unistd.h>
#define RENDER_IS_TERMINAL() (isatty(2) != 0)
#endif

namespace render {
namespace {

struct Spread {
    double min = 0, median = 0, max = 0;
};

// A pass's first frame also compiles its shader on some drivers: it counts only where there is no other.
Spread spreadOf(std::vector<double> milliseconds) {
    if (milliseconds.size() > 1) milliseconds.erase(milliseconds.begin());
    if (milliseconds.empty()) return {};
    std::sort(milliseconds.begin(), milliseconds.end());
    const size_t half = milliseconds.size() / 2;
    const bool even = milliseconds.size() % 2 == 0;
    const double median = even ? 0.5 * (milliseconds[half - 1] + milliseconds[half]) : milliseconds[half];
    return {milliseconds.front(), median, milliseconds.back()};
}

struct MemorySums {
    uint64_t total = 0;
    double perPixel = 0;
};

MemorySums sumUp(const Options& options, const Report& report) {
    MemorySums sums;
    uint64_t pixelBytes = 0;
    for (const restir::BufferInfo& buffer : report.buffers) {
        sums.total += buffer.bytes;
        if (buffer.perPixel) pixelBytes += buffer.bytes;
    }
    sums.perPixel =
        static_cast<double>(pixelBytes) / (static_cast<double>(options.size.width) * options.size.height);
    return sums;
}

}   // namespace

void printTable(const Options& options, const Report& report) {
    std::printf("%s, %llu triangles (%llu emissive), %llu lights\n", options.scene.scene.c_str(),
                static_cast<unsigned long long>(report.triangles),
                static_cast<unsigned long long>(report.emissiveTriangles),
                static_cast<unsigned long long>(report.lights));
    std::printf("%ux%u, %u frames in %.1f s, mode %s, on %s\n", options.size.width, options.size.height,
                options.frames, report.seconds, options.mode.c_str(), report.device.c_str());
    if (!report.passes.empty())
        std::printf("\n%-20s %10s %10s %10s\n", "pass, GPU ms", "min", "median", "max");
    double total = 0;
    for (const samples::PassStats& pass : report.passes) {
        const Spread spread = spreadOf(pass.milliseconds);
        total += spread.median;
        std::printf("%-20s %10.3f %10.3f %10.3f\n", pass.name.c_str(), spread.min, spread.median, spread.max);
    }
    if (!report.passes.empty()) std::printf("%-20s %10s %10.3f\n\n", "sum", "", total);
    const double pixels = static_cast<double>(options.size.width) * options.size.height;
    std::printf("rays %.0f per frame, %.2f per pixel\n", report.raysPerFrame, report.raysPerFrame / pixels);
    if (!report.buffers.empty()) {
        const MemorySums sums = sumUp(options, report);
        std::printf("memory %.2f MiB, of which %.1f bytes per pixel\n",
                    static_cast<double>(sums.total) / 1048576.0, sums.perPixel);
    }
    if (report.rejectedWeights > 0) {
        std::printf("weights rejected in the last frame: %llu\n",
                    static_cast<unsigned long long>(report.rejectedWeights));
    }
    if (options.validate) std::printf("validation messages: %u\n", report.validationMessages);
}

std::string toJson(const Options& options, const Report& report) {
    using Json = nlohmann::ordered_json;
    const MemorySums sums = sumUp(options, report);
    Json passes = Json::array(), buffers = Json::array();
    for (const samples::PassStats& pass : report.passes) {
        const Spread spread = spreadOf(pass.milliseconds);
        passes.push_back({{"name", pass.name},
                          {"gpuMs", {{"min", spread.min}, {"median", spread.median}, {"max", spread.max}}}});
    }
    for (const restir::BufferInfo& buffer : report.buffers) {
        buffers.push_back({{"name", buffer.name}, {"bytes", buffer.bytes}});
    }
    const Json json = {
        {"device", report.device},
        {"driver", report.driver},
        {"scene",
         {{"triangles", report.triangles},
          {"emissiveTriangles", report.emissiveTriangles},
          {"lights", report.lights}}},
        {"size", {options.size.width, options.size.height}},
        {"frames", options.frames},
        {"seed", options.seed},
        {"mode", options.mode},
        {"passes", passes},
        {"raysPerFrame", report.raysPerFrame},
        {"memory", {{"totalBytes", sums.total}, {"bytesPerPixel", sums.perPixel}, {"buffers", buffers}}},
        {"validationMessages", report.validationMessages}};
    return json.dump(2) + "\n";
}

Progress::Progress(bool quiet) : quiet_(quiet), terminal_(RENDER_IS_TERMINAL()) {}

void Progress::operator()(uint32_t done, uint32_t all) {
    if (quiet_) return;
    if (terminal_) {
        std::fprintf(stderr, "\rframe %u of %u%s", done, all, done == all ? "\n" : "");
        return;
    }
    const auto tenths = static_cast<uint32_t>(uint64_t{10} * done / all);
    if (tenths == printed_) return;
    printed_ = tenths;
    std::fprintf(stderr, "frame %u of %u\n", done, all);
}

}   // namespace render
