// What passes hand on to one another, and the barriers between them.
#include <algorithm>

#include <gtest/gtest.h>

#include "host/plans.h"

namespace tests {
namespace {

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
            if (name == "gi.fill") {   // of what the pass that shades left in a buffer of direct light
                EXPECT_NE(uses(pass, Resource::ReservoirsA, false), uses(pass, Resource::ReservoirsB, false));
                const Resource lit =
                    uses(pass, Resource::ReservoirsA, false) ? Resource::ReservoirsA : Resource::ReservoirsB;
                const PassInfo& before = *(&pass - 1);
                EXPECT_TRUE(isIndirect(before) && before.shades && uses(before, lit, true)) << before.name;
                continue;
            }
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
}   // namespace tests
