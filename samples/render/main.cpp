// restir-render: a scene in, a picture out, no display needed.
#include <cstdio>
#include <exception>

#include "render/render.h"

int main(int argc, char** argv) {
    try {
        const auto options = render::parseOptions(argc, argv);
        if (!options) return 0;
        const render::Outcome outcome = render::render(*options);
        render::writeFiles(*options, outcome);
        if (!options->quiet) render::printTable(*options, outcome.report);
        if (!options->quiet) render::printLegend(*options);
        return outcome.report.validationMessages == 0 ? 0 : 1;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "restir-render: %s\n", error.what());
        return 1;
    }
}
