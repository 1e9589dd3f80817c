// What the SDK's debug views are called, and what their colours mean.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <restir/settings.h>

namespace samples {

struct DebugViewName {
    restir::DebugView view;
    const char* name;
};
std::span<const DebugViewName> debugViews();   // all but None
// Throws std::runtime_error listing them.
restir::DebugView findDebugView(std::string_view name);
std::string debugViewList();   // "a|b|c"

struct DebugLegend {
    struct Line {
        const char* color;   // in words
        float rgb[3];        // and as the shader writes it
        std::string meaning;
    };
    const char* title = "";   // what the number behind each colour (A) is
    std::vector<Line> lines;
};
// `di` gives the ends of the ramp of Confidence.
DebugLegend legendOf(restir::DebugView view, const restir::DiSettings& di);

}   // namespace samples
