// Lines over logarithmic axes, as SVG.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace bench {

struct Line {
    std::string name;
    std::vector<std::pair<double, double>> points;   // both > 0
    bool dashed = false;
};

struct Chart {
    std::string title, xName, yName;
    std::vector<Line> lines;
};

// Throws std::runtime_error where there are no points.
std::string toSvg(const Chart& chart);

}   // namespace bench
