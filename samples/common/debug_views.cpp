#include "common/debug_views.h"

#include <array>
#include <cstdio>
#include <stdexcept>

namespace samples {
namespace {

using restir::DebugView;
using Line = DebugLegend::Line;

constexpr DebugViewName kNames[] = {{DebugView::Age, "age"},
                                    {DebugView::Confidence, "confidence"},
                                    {DebugView::Duplicates, "duplicates"},
                                    {DebugView::Light, "light"},
                                    {DebugView::Neighbours, "neighbours"},
                                    {DebugView::Samples, "samples"},
                                    {DebugView::Visibility, "visibility"},
                                    {DebugView::Weight, "weight"}};

// The stops of the shader's ramp (restir/di/debug.glsl).
std::vector<Line> ramp(const std::array<double, 5>& stops) {
    std::vector<Line> lines = {{"dark blue", {0.03f, 0.03f, 0.3f}, ""},
                               {"blue", {0.1f, 0.4f, 0.9f}, ""},
                               {"green", {0.15f, 0.75f, 0.35f}, ""},
                               {"yellow", {1.0f, 0.85f, 0.2f}, ""},
                               {"red", {0.9f, 0.1f, 0.1f}, ""}};
    for (size_t i = 0; i < stops.size(); ++i) {
        char number[32];
        std::snprintf(number, sizeof number, "%g", stops[i]);
        lines[i].meaning = number;
    }
    lines.front().meaning += " or less";
    lines.back().meaning += " or more";
    return lines;
}

DebugLegend coloursOf(DebugView view, const restir::DiSettings& di) {
    const double most = double(di.maxHistory + 1) * double(di.neighbours + 1);
    switch (view) {
        case DebugView::None:
            break;
        case DebugView::Confidence:
            return {"confidence M in pixel-frames", ramp({0, most / 4, most / 2, 3 * most / 4, most})};
        case DebugView::Age:
            return {"age of the sample in frames", ramp({0, 3, 15, 63, 255})};
        case DebugView::Weight:
            return {"contribution weight W", ramp({1e-2, 1, 1e2, 1e4, 1e6})};
        case DebugView::Duplicates:
            return {"pixels of the 48 around with the same point on the same light",
                    ramp({0, 3, 12, 27, 48})};
        case DebugView::Light:
            return {"a colour for each light; A: its id", {}};
        case DebugView::Visibility:
            return {"whether the pixel sees its sample",
                    {{"green", {0.15f, 0.75f, 0.35f}, "visible, A: 1"},
                     {"red", {0.9f, 0.1f, 0.1f}, "occluded, A: 0"}}};
        case DebugView::Samples:
            return {"point on the light; A: its distance in metres, 1e30 where infinite",
                    {{"red", {1, 0, 0}, "vertex 1 of a triangle, else u"},
                     {"green", {0, 1, 0}, "vertex 2, else v"},
                     {"blue", {0, 0, 1}, "vertex 0, else what u and v leave of 1"}}};
        case DebugView::Neighbours:
            return {
                "what became of the neighbours that the last spatial pass asked, in shares; A: how many it "
                "took",
                {{"dark grey", {0.15f, 0.15f, 0.15f}, "taken"},
                 {"red", {1.0f, 0.1f, 0.1f}, "rejected: another normal"},
                 {"blue", {0.15f, 0.3f, 1.0f}, "rejected: off this surface's plane"},
                 {"green", {0.1f, 0.8f, 0.1f}, "rejected: no surface there"},
                 {"white", {1, 1, 1}, "outside the image, or the pixel itself"}}};
    }
    return {};
}

}   // namespace

std::span<const DebugViewName> debugViews() { return kNames; }

restir::DebugView findDebugView(std::string_view name) {
    for (const DebugViewName& known : kNames)
        if (known.name == name) return known.view;
    throw std::runtime_error("'" + std::string(name) + "' is no debug view, known: " + debugViewList());
}

std::string debugViewList() {
    std::string list;
    for (const DebugViewName& known : kNames) list += (list.empty() ? "" : "|") + std::string(known.name);
    return list;
}

DebugLegend legendOf(DebugView view, const restir::DiSettings& di) {
    DebugLegend legend = coloursOf(view, di);
    if (view == DebugView::None) return legend;
    legend.lines.push_back({"black", {0, 0, 0}, "no surface, A: 0"});
    if (view != DebugView::Confidence && view != DebugView::Neighbours)
        legend.lines.push_back({"grey", {0.5f, 0.5f, 0.5f}, "no sample, A: -1"});
    return legend;
}

}   // namespace samples
