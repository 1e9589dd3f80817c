#include <array>
#include <cstdio>

#include "render/report.h"

namespace render {
namespace {

using restir::DebugView;

void line(const char* color, const char* meaning) { std::printf("  %-10s %s\n", color, meaning); }

// The stops of the shader's ramp (restir/di/debug.glsl).
void printRamp(const char* number, const std::array<double, 5>& stops) {
    constexpr const char* kColors[] = {"dark blue", "blue", "green", "yellow", "red"};
    std::printf("%s; colours between are in between\n", number);
    for (size_t i = 0; i < stops.size(); ++i) {
        const bool ends = i == 0 || i + 1 == stops.size();
        std::printf("  %-10s %g%s\n", kColors[i], stops[i], !ends ? "" : i == 0 ? " or less" : " or more");
    }
}

void printNeighbours() {
    std::printf(
        "what became of the neighbours that the last spatial pass asked, in shares; A: how many it took\n");
    line("dark grey", "taken");
    line("red", "rejected: another normal");
    line("blue", "rejected: off this surface's plane");
    line("green", "rejected: no surface there");
    line("white", "outside the image, or the pixel itself");
}

void printView(const Options& options) {
    const double most =
        double(options.settings.di.maxHistory + 1) * double(options.settings.di.neighbours + 1);
    switch (options.settings.debugView) {
        case DebugView::None:
            return;
        case DebugView::Confidence:
            return printRamp("confidence M in pixel-frames", {0, most / 4, most / 2, 3 * most / 4, most});
        case DebugView::Age:
            return printRamp("age of the sample in frames", {0, 3, 15, 63, 255});
        case DebugView::Weight:
            return printRamp("contribution weight W", {1e-2, 1, 1e2, 1e4, 1e6});
        case DebugView::Duplicates:
            return printRamp("pixels of the 48 around with the same point on the same light",
                             {0, 3, 12, 27, 48});
        case DebugView::Light:
            std::printf("a colour for each light; A: its id\n");
            return;
        case DebugView::Visibility:
            std::printf("whether the pixel sees its sample\n");
            line("green", "visible, A: 1");
            line("red", "occluded, A: 0");
            return;
        case DebugView::Samples:
            std::printf("point on the light; A: its distance in metres, 1e30 where infinite\n");
            line("red", "vertex 1 of a triangle, else u");
            line("green", "vertex 2, else v");
            line("blue", "vertex 0, else what u and v leave of 1");
            return;
        case DebugView::Neighbours:
            return printNeighbours();
    }
}

}   // namespace

void printLegend(const Options& options) {
    if (options.settings.debugView == DebugView::None) return;
    std::printf("\ndebug: ");
    printView(options);
    line("black", "no surface, A: 0");
    if (options.settings.debugView != DebugView::Confidence &&
        options.settings.debugView != DebugView::Neighbours)
        line("grey", "no sample, A: -1");
}

}   // namespace render
