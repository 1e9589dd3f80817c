// The passes of a frame and their order.
#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include <frame/pass_pipelines.h>
#include <frame/session_impl.h>

#include "host/plans.h"

namespace tests {
namespace {

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
    EXPECT_EQ(order(true, {.boilingFilter = 0.5f}),
              (Names{"surface.pack", "gi.candidates", "gi.temporal", "gi.boiling", "gi.spatial", "di.off"}));
    EXPECT_EQ(order(false, {.boilingFilter = 0.5f}),
              (Names{"surface.pack", "gi.candidates", "gi.spatial", "di.off"}));
    EXPECT_EQ(order(true, {.spatialPasses = 2, .pairedNeighbours = true}),
              (Names{"surface.pack", "gi.candidates", "gi.temporal", "gi.pair_targets", "gi.pair_spatial",
                     "gi.pair_targets", "gi.pair_spatial", "di.off"}));
    EXPECT_EQ(order(false, {.pairedNeighbours = true, .weights = Weights::Balance}),
              (Names{"surface.pack", "gi.candidates", "gi.spatial", "gi.shade", "di.off"}));
    EXPECT_EQ(order(true, {.checkerboard = true}),
              (Names{"surface.pack", "gi.candidates", "gi.temporal", "gi.spatial", "gi.fill", "di.off"}));
    EXPECT_EQ(order(true, {.halfResolution = true}),
              (Names{"surface.pack", "gi.candidates", "gi.temporal", "gi.spatial", "gi.fill", "di.off"}));
    EXPECT_EQ(order(true, {.mode = IndirectMode::Path, .checkerboard = true}),
              (Names{"surface.pack", "gi.candidates", "di.off"}));
    EXPECT_EQ(order(true, {.mode = IndirectMode::Path}), (Names{"surface.pack", "gi.candidates", "di.off"}));
    EXPECT_EQ(names(makePlan({kExtent, true, 0, false, true, 0}, {.gi = {.mode = IndirectMode::Restir}})),
              (Names{"surface.pack", "gi.candidates", "gi.temporal", "gi.spatial", "di.candidates",
                     "di.temporal", "di.spatial"}));
}

// Else it would be recorded without one.
TEST(Plan, EveryPassHasAPipeline) {
    const PassPipelines pipelines;
    for (const Plan& plan : allPlans())
        for (const PassInfo& pass : plan.passes)
            EXPECT_TRUE(std::any_of(pipelines.all().begin(), pipelines.all().end(), [&](const auto& pipeline) {
                return std::string(pipeline.pass) == pass.name;
            })) << pass.name;
}

Plan longestPlan() {
    return makePlan({kExtent, true, 0, true, true, 0},
                    {.di = {.spatialPasses = kMaxSpatialPasses,
                            .checkerboard = true,
                            .pairedNeighbours = true,
                            .averageShading = false,
                            .boilingFilter = 0.5f},
                     .gi = {.mode = IndirectMode::Restir,
                            .spatialPasses = kMaxSpatialPasses,
                            .pairedNeighbours = true,
                            .checkerboard = true,
                            .averageShading = false,
                            .boilingFilter = 0.5f},
                     .debugView = DebugView::Age});
}

// What README says of PipelineCreation::OnDemand.
TEST(Plan, NeedsFewOfThePipelines) {
    const auto pipelines = [](const Plan& plan) {
        std::set<std::string> passes;
        for (const PassInfo& pass : plan.passes) passes.insert(pass.name);
        return passes.size();
    };
    EXPECT_EQ(pipelines(makePlan({.extent = kExtent}, {.di = {.mode = DirectMode::Off}})), 2u);
    EXPECT_EQ(pipelines(longestPlan()), 17u);
    EXPECT_EQ(PassPipelines().all().size(), 38u);
}

// What it reads is what direct light's passes begin with.
TEST(Plan, IndirectLightIsAddedOnceAndBeforeItIsWritten) {
    for (const Settings& settings : allSettings()) {
        const Plan plan = makePlan({kExtent, true, 0, false, true, 0}, settings);
        // To half of the pixels; to the others gi.fill does.
        const auto adds = [](const PassInfo& pass) { return isIndirect(pass) && pass.shades && stageOf(pass) != "fill"; };
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
    const Plan plan = makePlan({kExtent, true, 0, false, true, 0},
                               {.di = {.spatialPasses = 3, .pairedNeighbours = true},
                                .gi = {.mode = IndirectMode::Restir, .spatialPasses = 3, .pairedNeighbours = true}});
    const PassInfo* targets = nullptr;
    uint32_t next = 0;
    for (const PassInfo& pass : plan.passes) {
        if (stageOf(pass) == "pair_targets") targets = &pass;
        if (stageOf(pass) != "pair_spatial") continue;
        ASSERT_NE(targets, nullptr);
        EXPECT_EQ(isIndirect(pass), isIndirect(*targets));
        EXPECT_EQ(pass.index, targets->index);
        EXPECT_EQ(pass.source, targets->source);
        EXPECT_TRUE(uses(*targets, Resource::Notes, true));
        EXPECT_TRUE(uses(pass, Resource::Notes, false));
        EXPECT_EQ(pass.index, next++ % 3);
    }
    EXPECT_EQ(next, 6u);
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

// A checkerboard's other pixels are filled after it. Lobes of indirect light have outputs of their own.
TEST(Plan, OutputsAreWrittenByTheLastPassOnly) {
    for (bool lobes : {false, true})
        for (const Plan& plan : allPlans(lobes))
            for (const PassInfo& pass : plan.passes) {
                const std::string name = pass.name;
                const bool last =
                    !onlyShows(pass) &&
                    std::all_of(&pass + 1, plan.passes.data() + plan.passes.size(),
                                [](const PassInfo& next) { return onlyShows(next) || fills(next); });
                EXPECT_EQ(uses(pass, Resource::DebugOutput, true), name == "di.debug") << name;
                EXPECT_EQ(uses(pass, Resource::GradientOutput, true), name == "di.gradient") << name;
                if (isIndirect(pass)) {
                    EXPECT_EQ(uses(pass, Resource::Outputs, true), lobes && pass.shades) << name;
                    continue;
                }
                EXPECT_EQ(uses(pass, Resource::Outputs, true), last) << name;
                EXPECT_EQ(pass.shades, last) << name;
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

// It needs the motion of pixels that di.fill's neighbours overwrite.
TEST(Plan, GradientComesBeforeAHalfIsLit) {
    for (const Settings& settings : allSettings()) {
        if (!settings.di.checkerboard) continue;
        const Plan plan = makePlan({kExtent, true, 0, true, true, 0}, settings);
        for (const PassInfo& pass : plan.passes) {
            if (std::string(pass.name) != "di.gradient") continue;
            EXPECT_TRUE(std::none_of(plan.passes.data(), &pass, [](const PassInfo& before) {
                return !isIndirect(before) && before.shades;
            }));
        }
    }
}

// What the Session has timestamps for.
TEST(Plan, TheLongestIsAsLongAsDeclared) { EXPECT_EQ(longestPlan().passes.size(), kMaxTimedPasses); }

// Each kind of light has its own half.
TEST(Plan, AHalfOfIndirectLightLeavesDirectLightWhole) {
    for (bool direct : {false, true}) {
        const Settings settings{.di = {.checkerboard = direct},
                                .gi = {.mode = IndirectMode::Restir, .checkerboard = !direct}};
        for (const PassInfo& pass : makePlan({kExtent, true, 0, false, true, 0}, settings).passes) {
            const std::string name = pass.name;
            const bool half = name != "surface.pack" && isIndirect(pass) != direct;
            EXPECT_EQ(pass.groups[0], half ? 21u : 41u) << name;
        }
    }
}

// A quarter of the pixels, all that fills in the others.
TEST(Plan, GroupsCoverABlock) {
    const Settings settings{.gi = {.mode = IndirectMode::Restir, .checkerboard = true, .halfResolution = true}};
    for (const PassInfo& pass : makePlan({kExtent, true, 0, false, true, 0}, settings).passes) {
        const std::string name = pass.name;
        const bool quarter = name != "surface.pack" && name != "gi.fill" && isIndirect(pass);
        EXPECT_EQ(pass.groups[0], quarter ? 21u : 41u) << name;
        EXPECT_EQ(pass.groups[1], quarter ? 12u : 23u) << name;
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

TEST(Plan, ARowAloneHasNoBlocks) {
    const Settings settings{.gi = {.mode = IndirectMode::Restir, .halfResolution = true}};
    for (uint32_t height : {1u, 2u}) {
        const Plan plan = makePlan({{9, height}, true, 0, false, true, 0}, settings);
        EXPECT_EQ(std::any_of(plan.passes.begin(), plan.passes.end(),
                              [](const PassInfo& pass) { return std::string(pass.name) == "gi.fill"; }),
                  height == 2);
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

}   // namespace
}   // namespace tests
