#include <cstdio>

#include "common/debug_views.h"
#include "render/report.h"

namespace render {

void printLegend(const Options& options) {
    if (!options.debugs()) return;
    const samples::DebugLegend legend = samples::legendOf(options.settings.debugView, options.settings.di);
    std::printf("\ndebug: %s\n", legend.title);
    for (const samples::DebugLegend::Line& line : legend.lines)
        std::printf("  %-10s %s\n", line.color, line.meaning.c_str());
}

}   // namespace render
