#include <imgui.h>

#include "common/scene_options.h"
#include "viewer/panels.h"

namespace viewer {
namespace {

void drawCounts(const Facts& facts) {
    const SceneCounts& counts = facts.stage.counts;
    const auto cell = [](uint64_t count, const char* name) {
        ImGui::TableNextColumn();
        ImGui::Text("%llu %s", static_cast<unsigned long long>(count), name);
    };
    if (ImGui::BeginTable("counts", 2)) {
        cell(counts.triangles, "triangles");
        cell(counts.emissiveTriangles, "of them emit");
        cell(counts.lights, "lights");
        cell(counts.instances, "instances");
        cell(counts.materials, "materials");
        cell(counts.textures, "textures");
        ImGui::EndTable();
    }
    ImGui::Text("loaded in %.1f s", facts.stage.loadSeconds);
}

void drawAnimation(State& state, const Facts& facts) {
    const auto& animations = facts.stage.animations;
    if (ImGui::BeginCombo("animation", animations[state.animation].name.c_str())) {
        for (size_t i = 0; i < animations.size(); ++i)
            if (ImGui::Selectable(animations[i].name.c_str(), i == state.animation)) state.animation = i;
        ImGui::EndCombo();
    }
    ImGui::Checkbox("playing", &state.playing);
    ImGui::SameLine();
    ImGui::SetNextItemWidth(100);
    ImGui::SliderFloat("pace", &state.pace, 0.05f, 4, "%.2f", ImGuiSliderFlags_Logarithmic);
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("the animation's frames for each one shown");
}

void drawRays(State& state) {
    const samples::RayBackendName& now = samples::rayBackend(state.rays);
    if (ImGui::BeginCombo("rays", now.name)) {
        for (const samples::RayBackendName& known : samples::rayBackends()) {
            if (ImGui::Selectable(known.name, known.backend == state.rays)) state.rays = known.backend;
            if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", known.help);
        }
        ImGui::EndCombo();
    }
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", now.help);
}

}   // namespace

void drawScene(State& state, const Facts& facts) {
    static constexpr const char* kBuiltin[] = {"builtin:market", "builtin:cornell", "builtin:rooms", "builtin:lamps",
                                               "builtin:street?triangles=100000&emissive=2000"};
    if (ImGui::BeginCombo("scene", facts.stage.name.c_str())) {
        for (const char* name : kBuiltin)
            if (ImGui::Selectable(name, facts.stage.name == name)) state.load = name;
        ImGui::EndCombo();
    }
    drawRays(state);
    ImGui::TextDisabled("or drop a .gltf or .glb file on the window");
    const auto& views = facts.stage.views;
    for (size_t i = 0; i < views.size() && i < 8; ++i) {
        if (i > 0) ImGui::SameLine();
        if (ImGui::Button(("camera " + std::to_string(i)).c_str())) state.lookThrough(views[i]);
        if (ImGui::IsItemHovered() && !views[i].name.empty()) ImGui::SetTooltip("%s", views[i].name.c_str());
    }
    drawAnimation(state, facts);
    drawCounts(facts);
    for (const std::string& warning : facts.stage.warnings) ImGui::TextWrapped("%s", warning.c_str());
}

void drawMemory(const Facts& facts) {
    uint64_t sum = 0, perPixel = 0;
    for (const restir::BufferInfo& buffer : facts.memory) {
        sum += buffer.bytes;
        if (buffer.perPixel) perPixel += buffer.bytes;
        ImGui::Text("%9.2f MiB  %s", static_cast<double>(buffer.bytes) / 1048576.0, buffer.name);
    }
    const double pixels = static_cast<double>(facts.extent.width) * facts.extent.height;
    ImGui::Text("%9.2f MiB  the library's in all, %.0f bytes a pixel shown",
                static_cast<double>(sum) / 1048576.0, static_cast<double>(perPixel) / pixels);
}

}   // namespace viewer
