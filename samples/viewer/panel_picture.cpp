#include <cmath>

#include <imgui.h>

#include "common/debug_views.h"
#include "viewer/panels.h"

namespace viewer {
namespace {

void tooltip(const char* text) {
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", text);
}

void drawExposure(State& state) {
    ImGui::Checkbox("automatic exposure", &state.autoExposure);
    tooltip("brings the picture's log-average luminance a little below middle gray");
    float stops = std::log2(state.exposure);
    if (ImGui::SliderFloat("exposure, stops", &stops, -12, 12, "%.1f")) {
        state.autoExposure = false;
        state.exposure = std::exp2(stops);
    }
}

void drawDebugChoice(State& state) {
    const restir::DebugView now = state.settings.debugView;
    const char* shown = "light";
    for (const samples::DebugViewName& known : samples::debugViews())
        if (known.view == now) shown = known.name;
    if (ImGui::BeginCombo("show", shown)) {
        if (ImGui::Selectable("light", now == restir::DebugView::None))
            state.settings.debugView = restir::DebugView::None;
        for (const samples::DebugViewName& known : samples::debugViews())
            if (ImGui::Selectable((std::string("reservoirs: ") + known.name).c_str(), known.view == now))
                state.settings.debugView = known.view;
        ImGui::EndCombo();
    }
    tooltip("what the reservoirs hold, instead of the light");
}

}   // namespace

void drawPicture(State& state, const Facts& facts) {
    drawDebugChoice(state);
    drawExposure(state);
    ImGui::SliderFloat("scale", &state.scale, 0.05f, 1.0f, "%.2f");
    tooltip("pixels rendered for one of the window's, a side");
    ImGui::SameLine();
    ImGui::Text("%ux%u", facts.extent.width, facts.extent.height);
    if (state.scale < 1) ImGui::Checkbox("smooth enlargement", &state.smooth);
    ImGui::Checkbox("denoise", &state.denoise);
    tooltip("filter the lobes over frames and neighbours, as an engine would; the error counts it, too");
    ImGui::Checkbox("reference on the right", &state.split);
    tooltip(
        "a path tracer that shares no code with the library, the mean of all frames since something moved; "
        "drag the line");
    ImGui::SameLine();
    ImGui::Checkbox("error", &state.measure);
    tooltip("trace the reference, and measure every frame against it");
    if (state.tracesReference()) ImGui::Text("%u paths a pixel in the reference", facts.referenceFrames);
    if (ImGui::Button("screenshot")) state.saveScreenshot();
    tooltip("the picture as .png, its radiance as .exr");
}

void drawLegend(const State& state) {
    if (state.settings.debugView == restir::DebugView::None) return;
    const samples::DebugLegend legend = samples::legendOf(state.settings.debugView, state.settings.di);
    ImGui::SetNextWindowPos({ImGui::GetIO().DisplaySize.x - 10, 10}, ImGuiCond_Always, {1, 0});
    if (ImGui::Begin(
            "Legend", nullptr,
            ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_AlwaysAutoResize)) {
        ImGui::PushTextWrapPos(360);
        ImGui::TextUnformatted(legend.title);
        ImGui::PopTextWrapPos();
        for (const samples::DebugLegend::Line& line : legend.lines) {
            ImGui::ColorButton(line.color, {line.rgb[0], line.rgb[1], line.rgb[2], 1},
                               ImGuiColorEditFlags_NoTooltip, {14, 14});
            ImGui::SameLine();
            ImGui::TextUnformatted(line.meaning.c_str());
        }
    }
    ImGui::End();
}

}   // namespace viewer
