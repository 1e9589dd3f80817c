// What a run tells: progress, a table, a JSON file.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <restir/session.h>

#include "common/renderer.h"
#include "render/options.h"

namespace render {

struct Report {
    std::string device, driver;
    uint64_t triangles = 0, emissiveTriangles = 0, lights = 0;
    std::vector<samples::PassStats> passes;
    double raysPerFrame = 0;
    uint64_t rejectedWeights = 0;   // in the last frame
    std::vector<restir::BufferInfo> buffers;
    uint32_t validationMessages = 0;
    double seconds = 0;   // from the first frame to the last
};

void printTable(const Options& options, const Report& report);
// What the colours of --debug mean, and the numbers behind them.
void printLegend(const Options& options);
std::string toJson(const Options& options, const Report& report);

// One line on stderr: rewritten on a terminal, else one every tenth of the frames.
class Progress {
public:
    explicit Progress(bool quiet);
    void operator()(uint32_t done, uint32_t all);

private:
    bool quiet_, terminal_;
    uint32_t printed_ = 0;   // tenths
};

}   // namespace render
