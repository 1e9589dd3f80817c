// restir-viewer: a scene in a window, and everything of the library's that can be changed while one looks at
// it.
#include <cstdio>
#include <exception>

#include "viewer/viewer.h"

namespace {

void report(const char* what, const std::vector<double>& milliseconds) {
    const viewer::Pacing pacing = viewer::pacingOf(milliseconds);
    std::printf("%-13s %6zu   mean %8.1f ms   p95 %8.1f ms   max %8.1f ms\n", what, pacing.frames,
                pacing.mean, pacing.p95, pacing.max);
}

}   // namespace

int main(int argc, char** argv) {
    try {
        const auto options = viewer::parseOptions(argc, argv);
        if (!options) return 0;
        viewer::Viewer viewer(*options);
        viewer.run();
        report("frames", viewer.history().steady());
        report("interruptions", viewer.history().interruptions());
        if (options->validate) std::printf("validation messages: %u\n", viewer.validationMessages());
        return viewer.validationMessages() == 0 ? 0 : 1;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "restir-viewer: %s\n", error.what());
        return 1;
    }
}
