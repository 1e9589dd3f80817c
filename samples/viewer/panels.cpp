#include "viewer/panels.h"

#include <imgui.h>

#include "viewer/input.h"

namespace viewer {
namespace {

constexpr float kMargin = 10, kControlsWidth = 380, kMeasuresWidth = 520;

void place(ImVec2 corner, ImVec2 pivot, ImVec2 size) {
    ImGui::SetNextWindowPos(corner, ImGuiCond_Always, pivot);
    ImGui::SetNextWindowSize(size, ImGuiCond_Always);
}

void complain(const std::string& text) {
    ImGui::PushTextWrapPos();
    ImGui::TextColored({1.0f, 0.45f, 0.35f, 1.0f}, "%s", text.c_str());
    ImGui::PopTextWrapPos();
}

void drawControls(State& state, const Facts& facts) {
    const float height = ImGui::GetIO().DisplaySize.y - 2 * kMargin;
    const bool roomy = height > 900;
    place({kMargin, kMargin}, {0, 0}, {kControlsWidth, height});
    if (ImGui::Begin("restir", nullptr, ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove)) {
        ImGui::PushItemWidth(-150);
        for (const std::string* text : {&state.refusal, &state.message})
            if (!text->empty()) complain(*text);
        if (ImGui::CollapsingHeader("Estimator", ImGuiTreeNodeFlags_DefaultOpen)) drawSettings(state);
        if (ImGui::CollapsingHeader("Picture", ImGuiTreeNodeFlags_DefaultOpen)) drawPicture(state, facts);
        if (ImGui::CollapsingHeader("Scene", roomy ? ImGuiTreeNodeFlags_DefaultOpen : 0))
            drawScene(state, facts);
        if (ImGui::CollapsingHeader("Memory")) drawMemory(facts);
        if (ImGui::CollapsingHeader("Keys")) ImGui::TextUnformatted(keysText());
        ImGui::PopItemWidth();
    }
    ImGui::End();
}

void drawLine(const State& state) {
    if (!state.split) return;
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    ImDrawList* list = ImGui::GetBackgroundDrawList();
    const float x = state.line * size.x;
    list->AddLine({x, 0}, {x, size.y}, IM_COL32(255, 255, 255, 200), 1.5f);
    const auto label = [&](const char* text, float at) {
        const ImVec2 extent = ImGui::CalcTextSize(text);
        list->AddRectFilled({at - 4, 8}, {at + extent.x + 4, 16 + extent.y}, IM_COL32(0, 0, 0, 160), 3);
        list->AddText({at, 12}, IM_COL32_WHITE, text);
    };
    label("ReSTIR", x - ImGui::CalcTextSize("ReSTIR").x - 12);
    label("reference", x + 12);
}

void drawLoading(const std::string& name) {
    if (name.empty()) return;
    const std::string text = "loading " + name;
    const ImVec2 size = ImGui::GetIO().DisplaySize, extent = ImGui::CalcTextSize(text.c_str());
    const ImVec2 corner{0.5f * (size.x - extent.x), 0.5f * (size.y - extent.y)};
    ImDrawList* list = ImGui::GetForegroundDrawList();
    list->AddRectFilled({corner.x - 16, corner.y - 12}, {corner.x + extent.x + 16, corner.y + extent.y + 12},
                        IM_COL32(0, 0, 0, 220), 4);
    list->AddText(corner, IM_COL32_WHITE, text.c_str());
}

}   // namespace

void drawPanels(State& state, const Facts& facts) {
    drawLine(state);
    drawLoading(facts.loading);
    if (!state.panels) return;
    drawControls(state, facts);
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    place({size.x - kMargin, size.y - kMargin}, {1, 1}, {kMeasuresWidth, 0});
    if (ImGui::Begin("Measures", nullptr,
                     ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_AlwaysAutoResize))
        drawMeasures(facts);
    ImGui::End();
    drawLegend(state);
}

}   // namespace viewer
