#include "viewer/script.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <functional>
#include <map>
#include <stdexcept>

#include "common/debug_views.h"
#include "common/scene_options.h"
#include "common/setting_options.h"

namespace viewer {
namespace {

template <class T>
T parseNumber(const std::string& text) {
    T value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size())
        throw std::runtime_error("'" + text + "' is no number");
    return value;
}

bool parseSwitch(const std::string& text) {
    if (text != "on" && text != "off") throw std::runtime_error("'" + text + "' is neither on nor off");
    return text == "on";
}

restir::DebugView parseView(const std::string& text) {
    return text == "off" ? restir::DebugView::None : samples::findDebugView(text);
}

glm::vec3 parseVector(const std::string& text) {
    glm::vec3 vector{0};
    size_t at = 0;
    for (int i = 0; i < 3; ++i) {
        const size_t space = std::min(text.find(' ', at), text.size());
        vector[i] = parseNumber<float>(text.substr(std::min(at, text.size()), space - at));
        at = space + 1;
    }
    return vector;
}

void animate(const std::string& name, State& state, const Stage& stage) {
    state.playing = name != "off";
    if (!state.playing) return;
    const auto found =
        std::find_if(stage.animations.begin(), stage.animations.end(),
                     [&](const samples::Animation& animation) { return animation.name == name; });
    if (found == stage.animations.end())
        throw std::runtime_error("the scene has no animation '" + name + "'");
    state.animation = static_cast<size_t>(found - stage.animations.begin());
}

void setExposure(const std::string& text, State& state) {
    state.autoExposure = text == "auto";
    if (!state.autoExposure) state.exposure = std::exp2(parseNumber<float>(text));
}

void lookThrough(const std::string& text, State& state, const Stage& stage) {
    const auto index = parseNumber<size_t>(text);
    if (index >= stage.views.size()) throw std::runtime_error("the scene has no camera " + text);
    state.lookThrough(stage.views[index]);
}

using Action = std::function<void(const std::string&, State&, const Stage&)>;

const std::map<std::string, Action>& actions() {
    static const std::map<std::string, Action> kActions = {
        {"set", [](const auto& text, State& s,
                   const Stage&) { s.settings = samples::parseSettings(text, s.settings); }},
        {"rays", [](const auto& text, State& s, const Stage&) { s.rays = samples::rayBackend(text).backend; }},
        {"debug", [](const auto& text, State& s, const Stage&) { s.settings.debugView = parseView(text); }},
        {"split", [](const auto& text, State& s, const Stage&) { s.split = parseSwitch(text); }},
        {"denoise", [](const auto& text, State& s, const Stage&) { s.denoise = parseSwitch(text); }},
        {"measure", [](const auto& text, State& s, const Stage&) { s.measure = parseSwitch(text); }},
        {"panels", [](const auto& text, State& s, const Stage&) { s.panels = parseSwitch(text); }},
        {"line", [](const auto& text, State& s, const Stage&) { s.line = parseNumber<float>(text); }},
        {"exposure", [](const auto& text, State& s, const Stage&) { setExposure(text, s); }},
        {"scale", [](const auto& text, State& s, const Stage&) { s.scale = parseNumber<float>(text); }},
        {"window", [](const auto& text, State& s, const Stage&) { s.windowSize = samples::parseSize(text); }},
        {"scene", [](const auto& text, State& s, const Stage&) { s.load = text; }},
        {"camera", lookThrough},
        {"fly",
         [](const auto& text, State& s, const Stage&) { s.camera.fly({.move = parseVector(text)}, 0.1f); }},
        {"orbit", [](const auto& text, State& s,
                     const Stage&) { s.camera.orbit(glm::radians(parseNumber<float>(text))); }},
        {"animate", animate},
        {"shot", [](const auto& text, State& s, const Stage&) { s.savePictures.push_back(text); }},
        {"panelshot", [](const auto& text, State& s, const Stage&) { s.saveWindow = text; }},
    };
    return kActions;
}

// What comes behind these wants them done: a scene is there, and a window is shown, with the next frame.
bool takesFrame(const std::string& name) { return name == "scene" || name == "panelshot"; }

}   // namespace

Script::Script(const std::string& path) : path_(path) {
    std::ifstream file(path);
    if (!file) throw std::runtime_error(path + ": cannot be read");
    std::string text;
    for (size_t line = 1; std::getline(file, text); ++line) {
        text.resize(std::min(text.find('#'), text.size()));
        text.resize(text.find_last_not_of(" \t\r") + 1);
        if (text.empty()) continue;
        const size_t space = std::min(text.find(' '), text.size());
        Command command{line, text.substr(0, space), space < text.size() ? text.substr(space + 1) : ""};
        if (command.name != "frames" && command.name != "compilations" && !actions().contains(command.name))
            throw std::runtime_error(path + ":" + std::to_string(line) + ": '" + command.name +
                                     "' is no command");
        commands_.push_back(std::move(command));
    }
}

void Script::run(const Command& command, State& state, const Stage& stage) {
    try {
        if (command.name == "frames") {
            frames_ = parseNumber<uint32_t>(command.argument);
        } else if (command.name == "compilations") {
            compilations_ = parseNumber<uint32_t>(command.argument);
        } else {
            actions().at(command.name)(command.argument, state, stage);
        }
    } catch (const std::runtime_error& error) {
        throw std::runtime_error(path_ + ":" + std::to_string(command.line) + ": " + error.what());
    }
}

bool Script::step(State& state, const Stage& stage) {
    if (state.compilations < compilations_) return true;
    while (frames_ == 0) {
        if (next_ == commands_.size()) {
            next_ = 0;
            return false;
        }
        const Command& command = commands_[next_++];
        run(command, state, stage);
        if (takesFrame(command.name) || state.compilations < compilations_) return true;
    }
    --frames_;
    return true;
}

}   // namespace viewer
