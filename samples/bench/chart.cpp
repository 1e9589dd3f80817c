#include "bench/chart.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

namespace bench {
namespace {

constexpr double kWidth = 860, kHeight = 520, kLeft = 70, kRight = 210, kTop = 40, kBottom = 50;
// Told apart without red against green (Wong 2011), then darker.
constexpr const char* kColors[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9",
                                   "#004466", "#7a3500", "#00543d", "#7d3c61", "#7f5800", "#2a6f97"};

struct Range {
    double low = 1e300, high = -1e300;   // logarithms to base 10
    void include(double value) {
        low = std::min(low, std::log10(value));
        high = std::max(high, std::log10(value));
    }
    double at(double value) const { return (std::log10(value) - low) / std::max(high - low, 1e-9); }
};

struct Frame {
    Range x, y;
    double px(double value) const { return kLeft + x.at(value) * (kWidth - kLeft - kRight); }
    double py(double value) const { return kHeight - kBottom - y.at(value) * (kHeight - kTop - kBottom); }
};

std::string text(double x, double y, const std::string& anchor, const std::string& words,
                 const char* color = "#333") {
    char head[200];
    std::snprintf(head, sizeof head, "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\" fill=\"%s\">", x, y,
                  anchor.c_str(), color);
    return head + words + "</text>\n";
}

std::string number(double value) {
    char words[32];
    std::snprintf(words, sizeof words, "%g", value);
    return words;
}

std::string segment(double x0, double y0, double x1, double y1) {
    char line[160];
    std::snprintf(line, sizeof line,
                  "<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" stroke=\"#ddd\"/>\n", x0, y0, x1,
                  y1);
    return line;
}

// Lines at 1, 2 and 5 times the powers of ten.
std::string grid(const Frame& frame) {
    std::string svg;
    for (int power = -8; power <= 8; ++power) {
        for (double factor : {1.0, 2.0, 5.0}) {
            const double value = factor * std::pow(10.0, power), log = std::log10(value);
            if (log >= frame.x.low - 1e-9 && log <= frame.x.high + 1e-9) {
                const double x = frame.px(value);
                svg += segment(x, kTop, x, kHeight - kBottom) +
                       text(x, kHeight - kBottom + 18, "middle", number(value));
            }
            if (log >= frame.y.low - 1e-9 && log <= frame.y.high + 1e-9) {
                const double y = frame.py(value);
                svg += segment(kLeft, y, kWidth - kRight, y) + text(kLeft - 8, y + 4, "end", number(value));
            }
        }
    }
    return svg;
}

std::string draw(const Line& line, const Frame& frame, const char* color) {
    std::string points;
    for (const auto& [x, y] : line.points) {
        char point[48];
        std::snprintf(point, sizeof point, "%.1f,%.1f ", frame.px(x), frame.py(y));
        points += point;
    }
    return "<polyline fill=\"none\" stroke-width=\"2\" stroke=\"" + std::string(color) + "\"" +
           (line.dashed ? " stroke-dasharray=\"6 5\"" : "") + " points=\"" + points + "\"/>\n";
}

// Names at the lines' ends, moved apart where they would cover one another.
std::string labels(const Chart& chart, const Frame& frame) {
    constexpr double kApart = 15;
    std::vector<std::pair<double, size_t>> ends;
    for (size_t i = 0; i < chart.lines.size(); ++i)
        if (!chart.lines[i].points.empty())
            ends.emplace_back(frame.py(chart.lines[i].points.back().second), i);
    std::sort(ends.begin(), ends.end());
    std::string svg;
    double last = -1e9;
    for (const auto& [y, i] : ends) {
        last = std::max(y, last + kApart);
        const char* color = chart.lines[i].dashed ? "#777" : kColors[i % std::size(kColors)];
        svg += text(kWidth - kRight + 8, last + 4, "start", chart.lines[i].name, color);
    }
    return svg;
}

}   // namespace

std::string toSvg(const Chart& chart) {
    Frame frame;
    for (const Line& line : chart.lines) {
        for (const auto& [x, y] : line.points) {
            frame.x.include(x);
            frame.y.include(y);
        }
    }
    if (frame.x.low > frame.x.high) throw std::runtime_error(chart.title + ": nothing to plot yet");
    char head[200];
    std::snprintf(
        head, sizeof head,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %g %g\" font-family=\"sans-serif\" "
        "font-size=\"13\">\n<rect width=\"100%%\" height=\"100%%\" fill=\"#fff\"/>\n",
        kWidth, kHeight);
    std::string svg = head + grid(frame);
    for (size_t i = 0; i < chart.lines.size(); ++i)
        svg += draw(chart.lines[i], frame, chart.lines[i].dashed ? "#777" : kColors[i % std::size(kColors)]);
    svg += labels(chart, frame) + text(kLeft, kTop - 15, "start", chart.title) +
           text((kLeft + kWidth - kRight) / 2, kHeight - 10, "middle", chart.xName) +
           text(kWidth - kRight, kTop - 15, "end", chart.yName);
    return svg + "</svg>\n";
}

}   // namespace bench
