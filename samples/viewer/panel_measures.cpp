#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstdio>

#include <imgui.h>

#include "viewer/panels.h"

namespace viewer {
namespace {

constexpr float kGraphHeight = 120;

bool isHosts(const std::string& pass) { return pass.starts_with("host."); }

// Of the library's passes hues, neighbours in the stack far apart; of the host's greys.
ImU32 colorOf(const History& history, size_t pass) {
    const float turn = static_cast<float>(pass) * 0.618034f;
    if (isHosts(history.passes()[pass])) return ImColor::HSV(0, 0, 0.3f + 0.4f * (turn - std::floor(turn)));
    return ImColor::HSV(turn - std::floor(turn), 0.6f, 0.85f);
}

struct Sums {
    double library = 0, host = 0;   // ms
};

Sums sumsOf(const History& history, const FrameRecord& record) {
    Sums sums;
    for (size_t i = 0; i < record.passes.size(); ++i)
        (isHosts(history.passes()[i]) ? sums.host : sums.library) += record.passes[i];
    return sums;
}

// A column for each frame, its passes one above the other.
void drawGraph(const History& history) {
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const ImVec2 size{ImGui::GetContentRegionAvail().x, kGraphHeight};
    double top = 1e-3;
    for (const FrameRecord& record : history.records()) {
        const Sums sums = sumsOf(history, record);
        top = std::max(top, sums.library + sums.host);
    }
    ImDrawList* list = ImGui::GetWindowDrawList();
    list->AddRectFilled(corner, {corner.x + size.x, corner.y + size.y}, IM_COL32(20, 20, 24, 255));
    const float width = size.x / static_cast<float>(History::kShown);
    float x = corner.x + size.x - width * static_cast<float>(history.records().size());
    for (const FrameRecord& record : history.records()) {
        float y = corner.y + size.y;
        for (const size_t i : history.order()) {
            if (i >= record.passes.size()) continue;
            const float height = size.y * static_cast<float>(record.passes[i] / top);
            list->AddRectFilled({x, y - height}, {x + width, y}, colorOf(history, i));
            y -= height;
        }
        x += width;
    }
    char label[32];
    std::snprintf(label, sizeof label, top < 100 ? "%.3g ms" : "%.0f ms", top);
    list->AddText({corner.x + 4, corner.y + 2}, IM_COL32(200, 200, 200, 255), label);
    ImGui::Dummy(size);
}

// The mean of the last frames that had it.
double recent(const History& history, size_t pass) {
    constexpr size_t kFrames = 20;
    double sum = 0;
    size_t count = 0;
    const auto& records = history.records();
    for (size_t i = records.size() - std::min(records.size(), kFrames); i < records.size(); ++i) {
        if (records[i].passes.size() <= pass || records[i].passes[pass] == 0) continue;
        sum += records[i].passes[pass];
        ++count;
    }
    return count > 0 ? sum / static_cast<double>(count) : 0;
}

void drawPasses(const History& history) {
    if (!ImGui::BeginTable("passes", 2)) return;
    for (const size_t i : history.order()) {
        const double milliseconds = recent(history, i);
        if (milliseconds == 0) continue;
        ImGui::TableNextColumn();
        ImGui::ColorButton(history.passes()[i].c_str(), ImColor(colorOf(history, i)),
                           ImGuiColorEditFlags_NoTooltip, {12, 12});
        ImGui::SameLine();
        ImGui::Text("%8.3f ms  %s", milliseconds, history.passes()[i].c_str());
    }
    ImGui::EndTable();
}

// Logarithms: the first ones are of a reference that is still noise itself.
void drawErrors(const Facts& facts) {
    const std::vector<float>& errors = facts.history.errors();
    if (errors.empty()) return;
    std::vector<float> logarithms;
    for (const float error : errors) logarithms.push_back(std::log10(std::max(error, 1e-9f)));
    char label[96];
    std::snprintf(label, sizeof label, "error %.3g, against %u paths a pixel",
                  static_cast<double>(errors.back()), facts.referenceFrames);
    ImGui::PushItemWidth(-1);
    ImGui::PlotLines("##error", logarithms.data(), static_cast<int>(logarithms.size()), 0, label, FLT_MAX,
                     FLT_MAX, {0, 60});
    ImGui::PopItemWidth();
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip(
            "of each frame: mean of (I - R)^2 / (R^2 + 0.01 mean(R)^2) over luminances, as restir-bench\n"
            "measures it, on a logarithmic scale; the reference's own noise is in it, and goes down with its "
            "paths");
}

}   // namespace

void drawMeasures(const Facts& facts) {
    const auto& records = facts.history.records();
    const double pixels = static_cast<double>(facts.extent.width) * facts.extent.height;
    std::vector<double> last;
    for (const FrameRecord& record : records)
        if (record.frame > 0) last.push_back(record.frame);
    const Pacing pacing = pacingOf(last);
    ImGui::Text("%s", facts.device.properties().deviceName);
    ImGui::Text("frames: %.1f ms mean, %.1f p95, %.1f max; %u in flight", pacing.mean, pacing.p95, pacing.max,
                samples::FrameSlots::kCount);
    ImGui::Text("%.2f rays a pixel", static_cast<double>(facts.counters.rays) / pixels);
    if (!facts.device.hasTimestamps())
        ImGui::TextDisabled("this queue has no timestamps: no times of passes");
    if (!records.empty()) {
        const Sums sums = sumsOf(facts.history, records.back());
        ImGui::Text("GPU: %.3f ms of the library, %.3f ms of the host", sums.library, sums.host);
        drawGraph(facts.history);
        drawPasses(facts.history);
    }
    drawErrors(facts);
}

}   // namespace viewer
