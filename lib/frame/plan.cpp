#include <frame/plan.h>

#include <algorithm>

#include <di/stages.h>
#include <surface/stages.h>

namespace restir {

Plan makePlan(const PlanInput& input, const Settings& settings) {
    Plan plan;
    const DiSettings& di = settings.di;
    auto add = [&](PassInfo pass) {
        pass.groups[0] = (input.extent.width + 7) / 8;
        pass.groups[1] = (input.extent.height + 7) / 8;
        pass.groups[2] = 1;
        plan.passes.push_back(pass);
    };

    add(surface::pack());
    if (di.mode == DirectMode::NextEvent) {
        add(di::nextEvent());
        plan.historyOut = input.historyIn;
        return plan;
    }
    const uint32_t history = input.historyIn;
    uint32_t current = 1 - history;
    add(di::candidates(current));
    const bool remembers = di.temporal && input.history;
    if (remembers) add(di::temporal(history, current));
    if (remembers && di.boilingFilter > 0) add(di::boiling(current));
    if (input.gradient) add(di::gradient(history, current));
    const bool averages = di.averageShading && di.spatialPasses > 0 && di.visibility == VisibilityReuse::Traced &&
                          (di.weights == Weights::Pairwise || di.weights == Weights::Off);
    for (uint32_t i = 0; i < di.spatialPasses; ++i) {
        add(di::spatial(current, 1 - current, i, averages && i + 1 == di.spatialPasses));
        current = 1 - current;
    }
    if (!averages) add(di::shade(current));
    if (settings.debugView != DebugView::None) add(di::debug(current, std::max(di.spatialPasses, 1u) - 1));
    plan.historyOut = current;
    return plan;
}

bool Hazards::conflicts(const PassInfo& pass) const noexcept {
    for (const PassInfo::Use& use : pass.uses()) {
        const uint32_t bit = 1u << uint32_t(use.resource);
        if (written & bit) return true;
        if (use.access != Access::Read && (read & bit)) return true;
    }
    return false;
}

void Hazards::add(const PassInfo& pass) noexcept {
    for (const PassInfo::Use& use : pass.uses()) {
        const uint32_t bit = 1u << uint32_t(use.resource);
        if (use.access != Access::Write) read |= bit;
        if (use.access != Access::Read) written |= bit;
    }
}

}   // namespace restir
