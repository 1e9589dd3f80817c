// The settings by the table that command lines are made of, each with its help as a tooltip.
#include <cmath>
#include <cstdio>

#include <imgui.h>

#include "common/setting_options.h"
#include "viewer/panels.h"

namespace viewer {
namespace {

using samples::SettingOption;

std::vector<std::string> choicesOf(const std::string& values) {
    std::vector<std::string> choices;
    for (size_t at = 0; at <= values.size();) {
        const size_t bar = std::min(values.find('|', at), values.size());
        choices.push_back(values.substr(at, bar - at));
        at = bar + 1;
    }
    return choices;
}

// Each of these is the new value, or nothing where it is the old one.
std::string editSwitch(const SettingOption& option, const std::string& value) {
    bool on = value == "on";
    if (!ImGui::Checkbox(option.name.c_str(), &on)) return {};
    return on ? "on" : "off";
}

std::string editChoice(const SettingOption& option, const std::string& value) {
    std::string chosen;
    if (!ImGui::BeginCombo(option.name.c_str(), value.c_str())) return chosen;
    for (const std::string& choice : choicesOf(option.values))
        if (ImGui::Selectable(choice.c_str(), choice == value)) chosen = choice;
    ImGui::EndCombo();
    return chosen;
}

std::string editNumber(const SettingOption& option, const std::string& value) {
    float number = std::stof(value);
    const bool wide = option.most > 100;   // over orders of magnitude
    const ImGuiSliderFlags flags = ImGuiSliderFlags_AlwaysClamp | (wide ? ImGuiSliderFlags_Logarithmic : 0);
    const char* format = option.whole ? "%.0f" : "%.3g";
    if (!ImGui::SliderFloat(option.name.c_str(), &number, static_cast<float>(option.least),
                            static_cast<float>(option.most), format, flags))
        return {};
    char text[32];
    std::snprintf(text, sizeof text, option.whole ? "%.0f" : "%.4g", static_cast<double>(number));
    return text;
}

void edit(const SettingOption& option, restir::Settings& settings) {
    const std::string value = option.get(settings);
    const bool changed = value != option.get({});
    if (changed) ImGui::PushStyleColor(ImGuiCol_Text, {1.0f, 0.85f, 0.5f, 1.0f});
    const std::string wanted = option.values == "on|off"                      ? editSwitch(option, value)
                               : option.values.find('|') != std::string::npos ? editChoice(option, value)
                                                                              : editNumber(option, value);
    if (changed) ImGui::PopStyleColor();
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", option.help.c_str());
    if (!wanted.empty()) option.set(settings, wanted);
}

}   // namespace

void drawSettings(State& state) {
    for (const PresetName& known : kPresets) {
        if (ImGui::Button(known.name)) samples::applyPreset(state.settings, known.preset);
        ImGui::SameLine();
    }
    if (ImGui::Button("defaults")) {
        state.settings.di = {};
        state.settings.gi = {.mode = state.settings.gi.mode, .bounces = state.settings.gi.bounces};
    }
    for (const SettingOption& option : samples::settingOptions()) edit(option, state.settings);
    samples::reuseAlike(state.settings);
}

}   // namespace viewer
