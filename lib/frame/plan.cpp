#include <frame/plan.h>

#include <algorithm>

#include <di/stages.h>
#include <frame/pass.h>
#include <surface/stages.h>

namespace restir {
namespace {

// Whether a pass can shade the mean of what it combines.
bool averagesInputs(const DiSettings& di) noexcept {
    return di.averageShading && di.visibility == VisibilityReuse::Traced && di.weights != Weights::Basic &&
           di.weights != Weights::Balance;
}

}   // namespace

bool alternates(VkExtent2D extent, const DiSettings& settings) noexcept {
    return settings.checkerboard && settings.mode == DirectMode::Restir && extent.width > 1;
}

Plan makePlan(const PlanInput& input, const Settings& settings) {
    Plan plan;
    const DiSettings& di = settings.di;
    const bool checkerboard = alternates(input.extent, di);
    auto addOver = [&](uint32_t width, PassInfo pass) {
        pass.groups[0] = (width + 7) / 8;
        pass.groups[1] = (input.extent.height + 7) / 8;
        pass.groups[2] = 1;
        if (checkerboard && pass.shades) addUse(pass, {Resource::Surfaces, Access::ReadWrite});   // for di.fill
        plan.passes.push_back(pass);
    };
    const uint32_t width = input.extent.width;
    auto add = [&](const PassInfo& pass) { addOver(checkerboard ? (width + 1) / 2 : width, pass); };

    addOver(width, surface::pack());
    if (di.mode == DirectMode::NextEvent) {
        add(di::nextEvent());
        plan.historyOut = input.historyIn;
        return plan;
    }
    const uint32_t history = input.historyIn;
    uint32_t current = 1 - history;
    add(di::candidates(current));
    const bool remembers = di.temporal && input.history;
    const bool fused = di.fused && remembers && di.spatialPasses > 0;
    const bool filters = remembers && di.boilingFilter > 0;
    const uint32_t spatialPasses = di.spatialPasses - (fused ? 1 : 0);
    // A filtered reservoir is shaded after the filter.
    const bool averages = averagesInputs(di) && (spatialPasses > 0 || (fused && !filters));
    if (fused) add(di::spatiotemporal(history, current, averages && spatialPasses == 0));
    else if (remembers) add(di::temporal(history, current));
    if (filters) add(di::boiling(current));
    if (input.gradient) add(di::gradient(history, current));
    const bool paired =
        di.pairedNeighbours && (di.weights == Weights::Pairwise || di.weights == Weights::PairwisePlain);
    for (uint32_t i = 0; i < spatialPasses; ++i) {
        const bool shades = averages && i + 1 == spatialPasses;
        if (paired) add(di::pairTargets(current, i));
        add(paired ? di::pairSpatial(current, 1 - current, i, shades)
                   : di::spatial(current, 1 - current, i, shades));
        current = 1 - current;
    }
    if (!averages) add(di::shade(current));
    if (checkerboard) add(di::fill(current));
    if (settings.debugView != DebugView::None)
        addOver(width, di::debug(current, std::max(spatialPasses, 1u) - 1));
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
