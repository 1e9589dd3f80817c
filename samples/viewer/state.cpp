#include "viewer/state.h"

#include <filesystem>

namespace viewer {

void State::lookThrough(const samples::View& view) {
    camera.place(view);
    cut = true;
    adapted = false;
}

void State::saveScreenshot() {
    const auto name = [](int number) { return "restir-" + std::to_string(number); };
    int number = 1;
    while (std::filesystem::exists(name(number) + ".png") || std::filesystem::exists(name(number) + ".exr"))
        ++number;
    savePictures = {name(number) + ".png", name(number) + ".exr"};
}

}   // namespace viewer
