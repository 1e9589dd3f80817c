#include <frame/pass.h>
#include <frame/plan.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace {

using namespace restir;

constexpr VkExtent2D kExtent{321, 180};

Settings settingsOf(bool temporal, uint32_t spatialPasses, VisibilityReuse visibility) {
    Settings settings;
    settings.di.temporal = temporal;
    settings.di.spatialPasses = spatialPasses;
    settings.di.visibility = visibility;
    return settings;
}

std::vector<Settings> allSettings() {
    std::vector<Settings> all;
    for (bool temporal : {false, true})
        for (uint32_t spatial = 0; spatial <= 3; ++spatial)
            for (auto visibility : {VisibilityReuse::None, VisibilityReuse::Cached, VisibilityReuse::Traced})
                all.push_back(settingsOf(temporal, spatial, visibility));
    for (size_t i = 0; i < 24; i += 5) {
        all.push_back(all[i]);
        all.back().debugView = DebugView::Light;
    }
    all.push_back({.di = {.boilingFilter = 0.5f}});
    const size_t separate = all.size();
    for (size_t i = 0; i < separate; ++i) {
        all.push_back(all[i]);
        all.back().di.fused = true;
    }
    for (uint32_t spatial : {1u, 3u})
        all.push_back({.di = {.spatialPasses = spatial, .pairedNeighbours = true}});
    for (auto visibility : {VisibilityReuse::None, VisibilityReuse::Traced})
        all.push_back({.di = {.checkerboard = true, .visibility = visibility}});
    all.push_back({.di = {.fused = true, .checkerboard = true}, .debugView = DebugView::Age});
    all.push_back({.di = {.mode = DirectMode::NextEvent}});
    all.push_back({.di = {.mode = DirectMode::Off}});
    for (auto direct : {DirectMode::Restir, DirectMode::Off})
        for (uint32_t spatial : {0u, 1u, 2u})
            for (bool average : {false, true})
                all.push_back(
                    {.di = {.mode = direct},
                     .gi = {
                         .mode = IndirectMode::Restir, .spatialPasses = spatial, .averageShading = average}});
    all.push_back({.gi = {.mode = IndirectMode::Path}});
    return all;
}

std::vector<Plan> allPlans() {
    std::vector<Plan> plans;
    for (const Settings& settings : allSettings())
        for (bool history : {false, true})
            for (uint32_t in : {0u, 1u})
                for (bool gradient : {false, true})
                    plans.push_back(makePlan({kExtent, history, in, gradient, history, 1 - in}, settings));
    return plans;
}

std::vector<std::string> names(const Plan& plan) {
    std::vector<std::string> result;
    for (const PassInfo& pass : plan.passes) result.emplace_back(pass.name);
    return result;
}

bool writes(Access access) { return access != Access::Read; }

// Whether the two passes touch a resource that one of them writes.
bool dependent(const PassInfo& a, const PassInfo& b) {
    for (const auto& x : a.uses())
        for (const auto& y : b.uses())
            if (x.resource == y.resource && (writes(x.access) || writes(y.access))) return true;
    return false;
}

// Which passes record() puts a barrier before.
std::vector<bool> barriersOf(const Plan& plan) {
    std::vector<bool> barriers;
    Hazards hazards;
    for (const PassInfo& pass : plan.passes) {
        barriers.push_back(hazards.conflicts(pass));
        if (barriers.back()) hazards = {};
        hazards.add(pass);
    }
    return barriers;
}

bool uses(const PassInfo& pass, Resource resource, bool writing) {
    for (const auto& use : pass.uses())
        if (use.resource == resource && (writing ? writes(use.access) : use.access != Access::Write))
            return true;
    return false;
}

bool isIndirect(const PassInfo& pass) { return std::string(pass.name).starts_with("gi."); }
// "temporal" of "di.temporal".
std::string stageOf(const PassInfo& pass) { return std::string(pass.name).substr(3); }

bool readsHistory(const PassInfo& pass) {
    return stageOf(pass) == "temporal" || stageOf(pass) == "spatiotemporal";
}

Resource reservoirBuffer(uint32_t i, bool indirect = false) {
    if (indirect) return i == 0 ? Resource::GiReservoirsA : Resource::GiReservoirsB;
    return i == 0 ? Resource::ReservoirsA : Resource::ReservoirsB;
}
Resource reservoirBuffer(uint32_t i, const PassInfo& pass) { return reservoirBuffer(i, isIndirect(pass)); }

bool isSpatial(const PassInfo& pass) { return stageOf(pass) == "spatial" || stageOf(pass) == "pair_spatial"; }

TEST(Plan, OrderOfStages) {
    using Names = std::vector<std::string>;
    const auto order = [](bool history, const Settings& s) {
        return names(makePlan({kExtent, history, 0}, s));
    };
    EXPECT_EQ(order(true, {}), (Names{"surface.pack", "di.candidates", "di.temporal", "di.spatial"}));
    EXPECT_EQ(order(false, {}), (Names{"surface.pack", "di.candidates", "di.spatial"}));
    EXPECT_EQ(order(true, {.di = {.averageShading = false}}),
              (Names{"surface.pack", "di.candidates", "di.temporal", "di.spatial", "di.shade"}));
    EXPECT_EQ(order(true, {.di = {.weights = Weights::Balance}}),
              (Names{"surface.pack", "di.candidates", "di.temporal", "di.spatial", "di.shade"}));
    EXPECT_EQ(order(true, {.di = {.boilingFilter = 0.5f}}),
              (Names{"surface.pack", "di.candidates", "di.temporal", "di.boiling", "di.spatial"}));
    EXPECT_EQ(order(false, {.di = {.boilingFilter = 0.5f}}),
              (Names{"surface.pack", "di.candidates", "di.spatial"}));
    EXPECT_EQ(order(true, settingsOf(false, 0, VisibilityReuse::None)),
              (Names{"surface.pack", "di.candidates", "di.shade"}));
    EXPECT_EQ(order(true, settingsOf(true, 2, VisibilityReuse::Traced)),
              (Names{"surface.pack", "di.candidates", "di.temporal", "di.spatial", "di.spatial"}));
    EXPECT_EQ(order(true, {.di = {.mode = DirectMode::NextEvent}}), (Names{"surface.pack", "di.next_event"}));
    EXPECT_EQ(order(true, {.debugView = DebugView::Age}),
              (Names{"surface.pack", "di.candidates", "di.temporal", "di.spatial", "di.debug"}));
    EXPECT_EQ(order(true, {.di = {.spatialPasses = 2, .pairedNeighbours = true}}),
              (Names{"surface.pack", "di.candidates", "di.temporal", "di.pair_targets", "di.pair_spatial",
                     "di.pair_targets", "di.pair_spatial"}));
    EXPECT_EQ(order(false, {.di = {.pairedNeighbours = true, .visibility = VisibilityReuse::None}}),
              (Names{"surface.pack", "di.candidates", "di.pair_targets", "di.pair_spatial", "di.shade"}));
    EXPECT_EQ(order(false, {.di = {.pairedNeighbours = true, .weights = Weights::Balance}}),
              (Names{"surface.pack", "di.candidates", "di.spatial", "di.shade"}));
    EXPECT_EQ(names(makePlan({kExtent, true, 0, true}, {})),
              (Names{"surface.pack", "di.candidates", "di.temporal", "di.gradient", "di.spatial"}));
    EXPECT_EQ(names(makePlan({kExtent, false, 0, true}, {})),
              (Names{"surface.pack", "di.candidates", "di.gradient", "di.spatial"}));
    EXPECT_EQ(order(true, {.di = {.checkerboard = true}}),
              (Names{"surface.pack", "di.candidates", "di.temporal", "di.spatial", "di.fill"}));
    EXPECT_EQ(order(true, {.di = {.mode = DirectMode::NextEvent, .checkerboard = true}}),
              (Names{"surface.pack", "di.next_event"}));
}

TEST(Plan, OrderOfIndirectStages) {
    using Names = std::vector<std::string>;
    const auto order = [](bool history, GiSettings gi) {
        gi.mode = gi.mode == IndirectMode::Off ? IndirectMode::Restir : gi.mode;
        return names(
            makePlan({kExtent, history, 0, false, history, 0}, {.di = {.mode = DirectMode::Off}, .gi = gi}));
    };
    EXPECT_EQ(order(true, {}),
              (Names{"surface.pack", "gi.candidates", "gi.temporal", "gi.spatial", "di.off"}));
    EXPECT_EQ(order(false, {}), (Names{"surface.pack", "gi.candidates", "gi.spatial", "di.off"}));
    EXPECT_EQ(order(true, {.spatialPasses = 0}),
              (Names{"surface.pack", "gi.candidates", "gi.temporal", "gi.shade", "di.off"}));
    EXPECT_EQ(order(true, {.visibility = VisibilityReuse::Cached}),
              (Names{"surface.pack", "gi.candidates", "gi.temporal", "gi.spatial", "gi.shade", "di.off"}));
    EXPECT_EQ(order(true, {.mode = IndirectMode::Path}), (Names{"surface.pack", "gi.candidates", "di.off"}));
    EXPECT_EQ(names(makePlan({kExtent, true, 0, false, true, 0}, {.gi = {.mode = IndirectMode::Restir}})),
              (Names{"surface.pack", "gi.candidates", "gi.temporal", "gi.spatial", "di.candidates",
                     "di.temporal", "di.spatial"}));
}

// What it reads is what direct light's passes begin with.
TEST(Plan, IndirectLightIsAddedOnceAndBeforeItIsWritten) {
    for (const Settings& settings : allSettings()) {
        const Plan plan = makePlan({kExtent, true, 0, false, true, 0}, settings);
        const auto adds = [](const PassInfo& pass) { return isIndirect(pass) && pass.shades; };
        EXPECT_EQ(std::count_if(plan.passes.begin(), plan.passes.end(), adds),
                  settings.gi.mode == IndirectMode::Off ? 0 : 1);
        const auto writer = std::find_if(plan.passes.begin(), plan.passes.end(), [](const PassInfo& pass) {
            return uses(pass, Resource::Outputs, true);
        });
        EXPECT_TRUE(std::none_of(writer, plan.passes.end(), isIndirect));
        for (const PassInfo& pass : plan.passes) {
            if (adds(pass)) {
                EXPECT_TRUE(uses(pass, Resource::Surfaces, true));
            }
            if (uses(pass, Resource::Outputs, true)) {
                EXPECT_TRUE(uses(pass, Resource::Surfaces, false));
            }
        }
    }
}

TEST(Plan, IndirectLobesAreWrittenOnce) {
    for (const Settings& settings : allSettings()) {
        const PlanInput input{.extent = kExtent, .history = true, .giHistory = true, .indirectLobes = true};
        for (const PassInfo& pass : makePlan(input, settings).passes)
            if (isIndirect(pass)) {
                EXPECT_EQ(uses(pass, Resource::Outputs, true), pass.shades);
            }
    }
}

// Both halves are of one pass: they draw the same partners.
TEST(Plan, PartnersAreOfOnePass) {
    const Plan plan = makePlan({kExtent, true, 0}, {.di = {.spatialPasses = 3, .pairedNeighbours = true}});
    const PassInfo* targets = nullptr;
    uint32_t next = 0;
    for (const PassInfo& pass : plan.passes) {
        if (std::string(pass.name) == "di.pair_targets") targets = &pass;
        if (std::string(pass.name) != "di.pair_spatial") continue;
        ASSERT_NE(targets, nullptr);
        EXPECT_EQ(pass.index, targets->index);
        EXPECT_EQ(pass.source, targets->source);
        EXPECT_TRUE(uses(*targets, Resource::Notes, true));
        EXPECT_TRUE(uses(pass, Resource::Notes, false));
        EXPECT_EQ(pass.index, next++);
    }
    EXPECT_EQ(next, 3u);
}

// One pass for two; a frame without history has no more to fuse than one without either kind of reuse.
TEST(Plan, OrderOfFusedStages) {
    using Names = std::vector<std::string>;
    const auto order = [](bool history, bool temporal, uint32_t spatialPasses, VisibilityReuse visibility) {
        Settings settings = settingsOf(temporal, spatialPasses, visibility);
        settings.di.fused = true;
        return names(makePlan({kExtent, history, 0}, settings));
    };
    const auto traced = VisibilityReuse::Traced;
    EXPECT_EQ(order(true, true, 1, traced), (Names{"surface.pack", "di.candidates", "di.spatiotemporal"}));
    EXPECT_EQ(order(true, true, 2, traced),
              (Names{"surface.pack", "di.candidates", "di.spatiotemporal", "di.spatial"}));
    EXPECT_EQ(order(true, true, 1, VisibilityReuse::None),
              (Names{"surface.pack", "di.candidates", "di.spatiotemporal", "di.shade"}));
    EXPECT_EQ(order(false, true, 1, traced), (Names{"surface.pack", "di.candidates", "di.spatial"}));
    EXPECT_EQ(order(true, false, 1, traced), (Names{"surface.pack", "di.candidates", "di.spatial"}));
    EXPECT_EQ(order(true, true, 0, traced),
              (Names{"surface.pack", "di.candidates", "di.temporal", "di.shade"}));
}

bool onlyShows(const PassInfo& pass) {
    return std::string(pass.name) == "di.debug" || std::string(pass.name) == "di.gradient";
}

// Once, and by the last pass but those that show what it left.
bool fills(const PassInfo& pass) { return std::string(pass.name) == "di.fill"; }

// A checkerboard's other pixels are filled after it.
TEST(Plan, OutputsAreWrittenByTheLastPassOnly) {
    for (const Plan& plan : allPlans())
        for (const PassInfo& pass : plan.passes) {
            const std::string name = pass.name;
            const bool last =
                !onlyShows(pass) &&
                std::all_of(&pass + 1, plan.passes.data() + plan.passes.size(),
                            [](const PassInfo& next) { return onlyShows(next) || fills(next); });
            EXPECT_EQ(uses(pass, Resource::DebugOutput, true), name == "di.debug") << name;
            EXPECT_EQ(uses(pass, Resource::GradientOutput, true), name == "di.gradient") << name;
            EXPECT_EQ(uses(pass, Resource::Outputs, true), last) << pass.name;
            if (!isIndirect(pass)) {
                EXPECT_EQ(pass.shades, last) << pass.name;
            }
        }
}

TEST(Plan, GroupsCoverTheExtent) {
    for (const PassInfo& pass : makePlan({kExtent, true, 0}, {}).passes) {
        EXPECT_EQ(pass.groups[0], 41u);
        EXPECT_EQ(pass.groups[1], 23u);
        EXPECT_EQ(pass.groups[2], 1u);
    }
    const Plan half =
        makePlan({kExtent, true, 0}, {.di = {.checkerboard = true}, .debugView = DebugView::Age});
    for (const PassInfo& pass : half.passes) {
        const std::string name = pass.name;
        EXPECT_EQ(pass.groups[0], name == "surface.pack" || name == "di.debug" ? 41u : 21u) << name;
        EXPECT_EQ(pass.groups[1], 23u);
    }
}

// It has no others to be filled from.
TEST(Plan, AColumnAloneIsNoCheckerboard) {
    const Settings settings{.di = {.checkerboard = true}};
    for (uint32_t width : {1u, 2u}) {
        const Plan plan = makePlan({{width, 9}, true, 0}, settings);
        EXPECT_EQ(std::any_of(plan.passes.begin(), plan.passes.end(), fills), width == 2);
    }
}

TEST(Plan, SpatialPassesAreNumbered) {
    uint32_t next = 0;
    for (const PassInfo& pass :
         makePlan({kExtent, true, 0}, settingsOf(true, 3, VisibilityReuse::Traced)).passes) {
        if (std::string(pass.name) != "di.spatial") continue;
        EXPECT_EQ(pass.index, next++);
    }
    EXPECT_EQ(next, 3u);
}

// What one pass declares is what its reservoir indices say, and neighbours come from a snapshot.
TEST(Plan, PassesReadNeighboursOnlyInBuffersTheyDoNotWrite) {
    for (const Plan& plan : allPlans()) {
        for (const PassInfo& pass : plan.passes) {
            const std::string name = pass.name;
            if (!readsHistory(pass) && !isSpatial(pass)) continue;
            EXPECT_NE(pass.source, pass.target) << name;
            EXPECT_TRUE(uses(pass, reservoirBuffer(pass.source, pass), false)) << name;
            EXPECT_FALSE(uses(pass, reservoirBuffer(pass.source, pass), true)) << name;
            EXPECT_TRUE(uses(pass, reservoirBuffer(pass.target, pass), true)) << name;
            EXPECT_EQ(uses(pass, reservoirBuffer(pass.target, pass), false), readsHistory(pass)) << name;
        }
    }
}

TEST(Plan, EveryPassReadsWhatThePassBeforeItMade) {
    for (const Plan& plan : allPlans()) {
        int latestOf[2] = {
            -1, -1};   // the reservoir buffer written last in this frame, of direct and indirect light
        for (const PassInfo& pass : plan.passes) {
            const std::string name = pass.name, stage = stageOf(pass);
            int& latest = latestOf[isIndirect(pass)];
            const uint32_t historyOut = isIndirect(pass) ? plan.giHistoryOut : plan.historyOut;
            if (name == "surface.pack" || name == "di.next_event" || name == "di.off") continue;
            if (stage == "candidates") {
                EXPECT_EQ(uses(pass, reservoirBuffer(pass.target, pass), true), !pass.shades);
            } else if (readsHistory(pass)) {
                EXPECT_EQ(static_cast<int>(pass.target), latest);
            } else if (isSpatial(pass) || stage == "pair_targets") {
                EXPECT_EQ(static_cast<int>(pass.source), latest);
            } else if (stage == "shade") {
                EXPECT_EQ(static_cast<int>(pass.source), latest);
                EXPECT_EQ(static_cast<int>(pass.target), latest);
                EXPECT_EQ(historyOut, pass.source);
                EXPECT_TRUE(uses(pass, reservoirBuffer(pass.source, pass), false));
            } else if (stage == "gradient") {
                EXPECT_EQ(static_cast<int>(pass.target), latest);
                EXPECT_NE(pass.source, pass.target);
            } else if (stage == "debug" || stage == "fill") {
                EXPECT_EQ(static_cast<int>(pass.source), latest);
                EXPECT_EQ(historyOut, pass.source);
            }
            if (stage != "debug") latest = static_cast<int>(pass.target);
        }
    }
}

TEST(Plan, HistoryIsReadWhereTheLastFrameLeftItAndBeforeItIsOverwritten) {
    for (const Settings& settings : allSettings()) {
        uint32_t history[2] = {0, 0};   // of direct and of indirect light
        for (int frame = 0; frame < 6; ++frame) {
            const Plan plan =
                makePlan({kExtent, frame > 0, history[0], frame % 2 == 0, frame > 0, history[1]}, settings);
            bool overwritten[2] = {}, read[2] = {};
            for (const PassInfo& pass : plan.passes) {
                const bool indirect = isIndirect(pass);
                if (readsHistory(pass)) {
                    EXPECT_FALSE(read[indirect]) << "once";
                    EXPECT_EQ(pass.source, history[indirect]);
                    EXPECT_FALSE(overwritten[indirect]);
                    EXPECT_TRUE(uses(pass, Resource::PreviousSurfaces, false));
                    read[indirect] = true;
                }
                if (std::string(pass.name) == "di.gradient") {
                    EXPECT_EQ(pass.source, history[0]);
                    EXPECT_FALSE(overwritten[0]);
                }
                for (const bool room : {false, true})
                    overwritten[room] |= uses(pass, reservoirBuffer(history[room], room), true);
            }
            EXPECT_EQ(read[0], settings.di.mode == DirectMode::Restir && settings.di.temporal && frame > 0);
            EXPECT_EQ(read[1], settings.gi.mode == IndirectMode::Restir && settings.gi.temporal && frame > 0);
            history[0] = plan.historyOut;
            history[1] = plan.giHistoryOut;
            ASSERT_LT(history[0], 2u);
            ASSERT_LT(history[1], 2u);
        }
    }
}

TEST(Plan, NextEventLeavesReservoirsAlone) {
    for (uint32_t in : {0u, 1u}) {
        const Plan plan = makePlan({kExtent, true, in}, {.di = {.mode = DirectMode::NextEvent}});
        EXPECT_EQ(plan.historyOut, in);
        for (const PassInfo& pass : plan.passes)
            for (uint32_t buffer : {0u, 1u})
                EXPECT_FALSE(uses(pass, reservoirBuffer(buffer), true)) << pass.name;
    }
}

TEST(Plan, BarriersSeparateEveryDependentPair) {
    for (const Plan& plan : allPlans()) {
        const std::vector<bool> barriers = barriersOf(plan);
        for (size_t j = 0; j < plan.passes.size(); ++j) {
            for (size_t i = 0; i < j; ++i) {
                if (!dependent(plan.passes[i], plan.passes[j])) continue;
                const auto first = barriers.begin() + static_cast<std::ptrdiff_t>(i) + 1;
                const auto last = barriers.begin() + static_cast<std::ptrdiff_t>(j) + 1;
                EXPECT_TRUE(std::any_of(first, last, [](bool b) { return b; }))
                    << plan.passes[i].name << " -> " << plan.passes[j].name;
            }
        }
    }
}

TEST(Plan, NoBarrierIsNeedless) {
    for (const Plan& plan : allPlans()) {
        const std::vector<bool> barriers = barriersOf(plan);
        EXPECT_FALSE(barriers[0]) << "record() starts with one of its own";
        size_t since = 0;
        for (size_t j = 0; j < plan.passes.size(); ++j) {
            if (!barriers[j]) continue;
            bool needed = false;
            for (size_t i = since; i < j; ++i) needed |= dependent(plan.passes[i], plan.passes[j]);
            EXPECT_TRUE(needed) << "before " << plan.passes[j].name;
            since = j;
        }
    }
}

// The three kinds of dependence one by one, and reads beside reads.
TEST(Hazards, KindsOfDependence) {
    const auto pass = [](Access access) {
        PassInfo info;
        info.useList[0] = {Resource::Surfaces, access};
        info.useCount = 1;
        return info;
    };
    for (Access before : {Access::Read, Access::Write, Access::ReadWrite}) {
        for (Access after : {Access::Read, Access::Write, Access::ReadWrite}) {
            Hazards hazards;
            hazards.add(pass(before));
            EXPECT_EQ(hazards.conflicts(pass(after)), writes(before) || writes(after));
        }
    }
}

TEST(Hazards, ResourcesAreIndependent) {
    PassInfo a, b;
    a.useList[0] = {Resource::ReservoirsA, Access::Write};
    b.useList[0] = {Resource::ReservoirsB, Access::ReadWrite};
    a.useCount = b.useCount = 1;
    Hazards hazards;
    EXPECT_FALSE(hazards.conflicts(a));
    hazards.add(a);
    EXPECT_FALSE(hazards.conflicts(b));
}

}   // namespace
