#include <frame/plan.h>

#include <algorithm>
#include <utility>

#include <di/stages.h>
#include <frame/pass.h>
#include <gi/stages.h>
#include <surface/stages.h>

namespace restir {
namespace {

// Whether a pass can shade the mean of what it combines.
bool averages(bool wanted, VisibilityReuse visibility, Weights weights) noexcept {
    return wanted && visibility == VisibilityReuse::Traced && weights != Weights::Basic &&
           weights != Weights::Balance;
}

// Whether partners can answer one another: other weights ask of third pixels.
template <class S>
bool pairs(const S& s) noexcept {
    return s.pairedNeighbours && (s.weights == Weights::Pairwise || s.weights == Weights::PairwisePlain);
}

class Planner {
public:
    Planner(const PlanInput& input, const Settings& settings) noexcept
        : input_(input), settings_(settings), cell_(cellOf(input.extent, settings.di)), giCell_(cellOf(input.extent, settings.gi)) {}

    Plan run() {
        add(surface::pack());
        if (settings_.gi.mode != IndirectMode::Off)
            indirect();
        else
            plan_.giHistoryOut = input_.giHistoryIn;
        direct();
        return std::move(plan_);
    }

private:
    void add(PassInfo pass, Cell cell = Cell::Pixel) {
        const auto cells = [](uint32_t pixels, bool halved) { return halved ? (pixels + 1) / 2 : pixels; };
        pass.groups[0] = (cells(input_.extent.width, cell != Cell::Pixel) + 7) / 8;
        pass.groups[1] = (cells(input_.extent.height, cell == Cell::Block) + 7) / 8;
        pass.groups[2] = 1;
        plan_.passes.push_back(pass);
    }
    // A stage of direct light: on all pixels, or on this frame's half of them.
    void addDirect(PassInfo pass) {
        if (cell_ != Cell::Pixel && pass.shades)
            addUse(pass, {Resource::Surfaces, Access::ReadWrite});   // for di.fill
        add(pass, cell_);
    }

    // A stage of indirect light.
    void addIndirect(PassInfo pass) { addIndirect(pass, giCell_); }
    void addIndirect(PassInfo pass, Cell cell) {
        if (input_.indirectLobes && pass.shades) addUse(pass, {Resource::Outputs, Access::Write});
        const bool own = input_.indirectLobes && showsOwnPath(settings_.gi);
        if ((giCell_ != Cell::Pixel || own) && pass.shades)   // for gi.fill, where direct light starts later; own lobes
            addUse(pass, {reservoirs(1 - input_.historyIn), Access::ReadWrite});
        add(pass, cell);
    }

    // The own path's part of a pixel, beside its reservoir: radiance at once, lobes for the pass that shades.
    void shadesOwn(PassInfo& pass) const {
        addUse(pass, {Resource::Surfaces, Access::ReadWrite});
        if (input_.indirectLobes || giCell_ != Cell::Pixel) addUse(pass, {reservoirs(1 - input_.historyIn), Access::Write});
    }

    void indirect() {
        const GiSettings& gi = settings_.gi;
        plan_.giHistoryOut = input_.giHistoryIn;
        if (gi.mode == IndirectMode::Path) return addIndirect(gi::path());
        uint32_t current = 1 - input_.giHistoryIn;
        PassInfo candidates = gi::candidates(current);
        if (showsOwnPath(gi)) shadesOwn(candidates);
        addIndirect(candidates);
        const bool remembers = gi.temporal && input_.giHistory;
        if (remembers) addIndirect(gi::temporal(input_.giHistoryIn, current));
        if (remembers && gi.boilingFilter > 0) addIndirect(gi::boiling(current));
        const bool means = averages(gi.averageShading, gi.visibility, gi.weights) && gi.spatialPasses > 0;
        for (uint32_t i = 0; i < gi.spatialPasses; ++i) {
            const bool shades = means && i + 1 == gi.spatialPasses;
            if (pairs(gi)) addIndirect(gi::pairTargets(current, i));
            addIndirect(pairs(gi) ? gi::pairSpatial(current, 1 - current, i, shades)
                                  : gi::spatial(current, 1 - current, i, shades));
            current = 1 - current;
        }
        if (!means) addIndirect(gi::shade(current));
        if (giCell_ != Cell::Pixel) addIndirect(gi::fill(), giCell_ == Cell::Pair ? Cell::Pair : Cell::Pixel);
        plan_.giHistoryOut = current;
    }

    void direct() {
        const DiSettings& di = settings_.di;
        plan_.historyOut = input_.historyIn;
        if (di.mode == DirectMode::Off) return add(di::off());
        if (di.mode == DirectMode::NextEvent) return addDirect(di::nextEvent());
        const uint32_t history = input_.historyIn;
        uint32_t current = 1 - history;
        addDirect(di::candidates(current));
        const bool remembers = di.temporal && input_.history;
        const bool fused = di.fused && remembers && di.spatialPasses > 0;
        const bool filters = remembers && di.boilingFilter > 0;
        // It looks at motion, which lit pixels of a checkerboard overwrite.
        const bool showsBefore = input_.gradient && cell_ != Cell::Pixel;
        const uint32_t spatialPasses = di.spatialPasses - (fused ? 1 : 0);
        // A reservoir is shaded after the filter.
        const bool means = averages(di.averageShading, di.visibility, di.weights) &&
                           (spatialPasses > 0 || (fused && !filters && !showsBefore));
        if (fused)
            addDirect(di::spatiotemporal(history, current, means && spatialPasses == 0));
        else if (remembers)
            addDirect(di::temporal(history, current));
        if (filters) addDirect(di::boiling(current));
        if (input_.gradient) addDirect(di::gradient(history, current));
        current = spatial(current, spatialPasses, means);
        if (!means) addDirect(di::shade(current));
        if (cell_ != Cell::Pixel) addDirect(di::fill(current));
        if (settings_.debugView != DebugView::None) add(di::debug(current, std::max(spatialPasses, 1u) - 1));
        plan_.historyOut = current;
    }

    uint32_t spatial(uint32_t current, uint32_t passes, bool means) {
        const DiSettings& di = settings_.di;
        for (uint32_t i = 0; i < passes; ++i) {
            const bool shades = means && i + 1 == passes;
            if (pairs(di)) addDirect(di::pairTargets(current, i));
            addDirect(pairs(di) ? di::pairSpatial(current, 1 - current, i, shades)
                                : di::spatial(current, 1 - current, i, shades));
            current = 1 - current;
        }
        return current;
    }

    const PlanInput& input_;
    const Settings& settings_;
    Cell cell_, giCell_;
    Plan plan_;
};

}   // namespace

Cell cellOf(VkExtent2D extent, const DiSettings& settings) noexcept {
    const bool pairs = settings.checkerboard && settings.mode == DirectMode::Restir && extent.width > 1;
    return pairs ? Cell::Pair : Cell::Pixel;
}

Cell cellOf(VkExtent2D extent, const GiSettings& settings) noexcept {
    if (settings.mode != IndirectMode::Restir || extent.width < 2) return Cell::Pixel;
    if (settings.halfResolution && extent.height > 1) return Cell::Block;
    return settings.checkerboard ? Cell::Pair : Cell::Pixel;
}

bool showsOwnPath(const GiSettings& settings) noexcept {
    return settings.mode == IndirectMode::Restir && settings.ownPath && settings.boilingFilter == 0;
}

Plan makePlan(const PlanInput& input, const Settings& settings) { return Planner(input, settings).run(); }

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
