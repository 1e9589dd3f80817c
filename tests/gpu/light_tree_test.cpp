// The tree that LightTable builds over its lights: what its nodes say, and that it draws lights with the
// chance that it says.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <numeric>
#include <random>

#include "gpu/built_table.h"
#include "light_tree.spv.h"
#include "support/gpu.h"
#include "support/statistics.h"

namespace {

using restir::Light;
using restir::LightKind;
using restir::gpu::uvec4;
using restir::gpu::vec3;
using tests::BuiltTable;

constexpr uint32_t kNone = 0xffffffffu, kLeaf = 0x80000000u;

class LightTree : public tests::GpuTest {};

struct Parameters {
    uint32_t job, seed, count, invocations;
    vec3 receiver, normal;
};
struct Draw {
    uint32_t light;
    float chance, again;
};

std::vector<Draw> run(const BuiltTable& table, const Parameters& parameters) {
    static const tests::Kernel kernel(k_light_tree_spv, 3);
    std::vector<Draw> draws(parameters.invocations);
    kernel.run((parameters.invocations + 63) / 64,
               {tests::in(std::vector{parameters}), tests::in(table.tree), tests::out(draws)});
    return draws;
}

struct Node {
    double mean[3], spread, power;
};
Node nodeOf(const BuiltTable& table, size_t i) {
    const uvec4& bits = table.tree[i];
    const auto radius = double(std::bit_cast<float>(bits.w >> 16 << 15));
    return {{double(std::bit_cast<float>(bits.x)), double(std::bit_cast<float>(bits.y)),
             double(std::bit_cast<float>(bits.z))},
            radius * radius,
            double(std::bit_cast<float>((bits.w & 0xffff) << 15))};
}
size_t columnsOf(const BuiltTable& table) { return table.alias.size(); }
uint32_t word(const BuiltTable& table, size_t i) {
    const uvec4& words = table.tree[i / 4];
    return std::array{words.x, words.y, words.z, words.w}[i % 4];
}
uint32_t below(const BuiltTable& table, size_t slot) { return word(table, 8 * columnsOf(table) + slot); }

struct Subtree {
    size_t slot = 0, leaves = 0;
};
// All slots, children before their parents, checked on the way; `order`: of the lights.
void walk(const BuiltTable& table, uint32_t node, std::vector<Subtree>& subtrees,
          std::vector<uint32_t>& order, int depth = 0) {
    const size_t columns = columnsOf(table);
    ASSERT_LT(node, columns - 1);
    ASSERT_LT(depth, 64);
    for (size_t slot : {2 * size_t{node}, 2 * size_t{node} + 1}) {
        const uint32_t child = below(table, slot);
        const bool leaf = child >> 31;
        const size_t before = order.size();
        if (leaf) {
            ASSERT_EQ(word(table, 11 * columns + (child & ~kLeaf)), slot);
            order.push_back(child & ~kLeaf);
        } else {
            ASSERT_EQ(word(table, 10 * columns + child), slot);
            ASSERT_NO_FATAL_FAILURE(walk(table, child, subtrees, order, depth + 1));
        }
        subtrees.push_back({slot, order.size() - before});
    }
}

// All kinds, from a speck to a street, some of them black, and every third id left out.
std::vector<Light> mixedLights(uint32_t count) {
    constexpr LightKind kinds[] = {LightKind::Triangle,    LightKind::Point,    LightKind::Spot,
                                   LightKind::Directional, LightKind::Sphere,   LightKind::Capsule,
                                   LightKind::Disk,        LightKind::Rectangle};
    std::mt19937 random(count);
    std::uniform_real_distribution<float> unit(-1, 1);
    std::vector<Light> lights;
    for (uint32_t i = 0; i < count; ++i) {
        Light light{.id = i + i / 2, .kind = kinds[i % 8], .radius = 0.3f};
        for (int k = 0; k < 3; ++k) {
            light.position[k] = 40 * unit(random);
            light.vertex1[k] = light.position[k] + unit(random);
            light.vertex2[k] = light.position[k] + unit(random);
            light.emission[k] = i % 7 == 3 ? 0 : std::exp(3 * unit(random));
        }
        lights.push_back(light);
    }
    return lights;
}

// What a set of nodes is as one, in double.
Node joined(const std::vector<Node>& nodes) {
    Node all{};
    for (const Node& node : nodes) all.power += node.power;
    for (const Node& node : nodes)
        for (int k = 0; k < 3; ++k) all.mean[k] += node.power * node.mean[k] / std::max(all.power, 1e-300);
    for (const Node& node : nodes) {
        double square = node.spread;
        for (int k = 0; k < 3; ++k) square += (node.mean[k] - all.mean[k]) * (node.mean[k] - all.mean[k]);
        all.spread += node.power * square / std::max(all.power, 1e-300);
    }
    return all;
}

TEST_F(LightTree, HoldsEveryLightOnce) {
    for (uint32_t count : {1u, 2u, 3u, 37u, 683u, 684u, 5000u, 60000u}) {
        const BuiltTable table = tests::build(mixedLights(count));
        std::vector<Subtree> subtrees;
        std::vector<uint32_t> order;
        ASSERT_NO_FATAL_FAILURE(walk(table, 0, subtrees, order)) << count;
        std::vector<Node> leaves;
        for (uint32_t light : order) {
            const Node node = nodeOf(table, word(table, 11 * columnsOf(table) + light));
            double wanted = 0;
            if (light < table.lights.size() &&
                (table.lights[light].kindAndTexture & RS_LIGHT_KIND_MASK) != RS_LIGHT_DIRECTIONAL)
                wanted = double(table.lights[light].selection);
            ASSERT_NEAR(node.power, wanted, wanted / 256) << "light " << light;
            leaves.push_back(node);
        }
        std::sort(order.begin(), order.end());
        ASSERT_EQ(order.size(), columnsOf(table));
        for (uint32_t i = 0; i < order.size(); ++i) ASSERT_EQ(order[i], i);
        const Node wanted = joined(leaves), root = nodeOf(table, 2 * columnsOf(table) - 1);
        EXPECT_NEAR(root.power, wanted.power, 0.02 * wanted.power) << count;
        EXPECT_NEAR(root.spread, wanted.spread, 0.02 * wanted.spread) << count;
        for (int k = 0; k < 3; ++k)
            EXPECT_NEAR(root.mean[k], wanted.mean[k], 0.02 * std::sqrt(wanted.spread)) << count;
    }
}

// Of a lattice, in whatever order its ids are, every cube is a subtree; lights in one place keep the order of
// their ids.
TEST_F(LightTree, FollowsTheCurve) {
    std::vector<Light> lattice, heap;
    for (uint32_t i = 0; i < 4096; ++i) {
        Light light{.id = (i * 1237u) % 4096u, .kind = LightKind::Point};
        heap.push_back(light);
        for (int k = 0; k < 3; ++k) light.position[k] = float(i >> 4 * k & 15);
        lattice.push_back(light);
    }
    const BuiltTable table = tests::build(lattice);
    std::vector<Subtree> subtrees;
    std::vector<uint32_t> order;
    ASSERT_NO_FATAL_FAILURE(walk(table, 0, subtrees, order));
    size_t cubes = 0;
    for (const auto& [slot, leaves] : subtrees)
        for (double edge : {1.0, 2.0, 4.0, 8.0})
            if (leaves == size_t(edge * edge * edge)) {
                EXPECT_NEAR(nodeOf(table, slot).spread, 3 * (edge * edge - 1) / 12, 0.02 * edge * edge)
                    << "slot " << slot;
                ++cubes;
            }
    EXPECT_EQ(cubes, 4096u + 512 + 64 + 8);
    order.clear();
    ASSERT_NO_FATAL_FAILURE(walk(tests::build(heap), 0, subtrees, order));
    for (uint32_t i = 0; i < 4096; ++i) ASSERT_EQ(order[i], i);
}

TEST_F(LightTree, DrawsWithTheChanceItSays) {
    const Parameters receivers[] = {{.receiver = {0, 0, 0}, .normal = {0, 0, 1}},
                                    {.receiver = {39, -20, 5}, .normal = {0, 1, 0}},
                                    {.receiver = {1000, 0, 0}, .normal = {-1, 0, 0}}};
    for (uint32_t count : {2u, 37u, 700u}) {
        const BuiltTable table = tests::build(mixedLights(count));
        const auto ids = static_cast<uint32_t>(table.lights.size());
        for (Parameters p : receivers) {
            p.count = ids;
            p.job = 1;
            p.invocations = ids;
            std::vector<double> chances;
            double sum = 0;
            for (const Draw& draw : run(table, p)) {
                const auto& light = table.lights[draw.light];
                const bool somewhere = (light.kindAndTexture & RS_LIGHT_KIND_MASK) != RS_LIGHT_DIRECTIONAL;
                EXPECT_EQ(draw.again > 0, somewhere && light.selection > 0) << "light " << draw.light;
                chances.push_back(double(draw.again));
                sum += double(draw.again);
            }
            EXPECT_NEAR(sum, 1, 2e-5) << count;
            p.job = 0;
            p.invocations = 1u << 19;
            p.seed = count;
            std::vector<uint64_t> counts(ids);
            for (const Draw& draw : run(table, p)) {
                ASSERT_LT(draw.light, ids);
                ASSERT_NEAR(draw.chance, draw.again, 1e-4f * draw.again);
                ++counts[draw.light];
            }
            EXPECT_LT(std::abs(tests::chiSquareZ(counts, chances, p.invocations)), 4.5) << count;
        }
    }
}

// A light nearby among many that are far away is found 200 times as often as by power.
TEST_F(LightTree, FindsTheLightNearby) {
    std::vector<Light> lights;
    for (uint32_t i = 0; i < 10'000; ++i)
        lights.push_back(
            {.id = i, .kind = LightKind::Point, .position = {float(i % 100) * 10, float(i / 100) * 10, 0}});
    const BuiltTable table = tests::build(lights);
    const std::vector<Draw> draws = run(
        table,
        {.job = 1, .count = 10'000, .invocations = 10'000, .receiver = {500, 500, 1}, .normal = {0, 0, -1}});
    EXPECT_GT(draws[50 * 100 + 50].again, 200e-4f);
}

// No lights, none that shines, none that is somewhere, all in one place, powers of forty decades, places
// beyond reason.
TEST_F(LightTree, WhatIsNotThereIsNotDrawn) {
    const auto draws = [](const std::vector<Light>& lights) {
        const BuiltTable table = tests::build(lights);
        return run(table, {.job = 0,
                           .seed = 1,
                           .count = uint32_t(table.lights.size()),
                           .invocations = 4096,
                           .receiver = {0, 0, 0},
                           .normal = {0, 1, 0}});
    };
    const Light black{.id = 0, .kind = LightKind::Point, .emission = {0, 0, 0}};
    const Light sun{.id = 0, .kind = LightKind::Directional};
    for (const Light& light : {black, sun})
        for (const Draw& draw : draws({light})) ASSERT_TRUE(draw.light == kNone && draw.chance == 0);
    std::vector<Light> one;
    for (uint32_t i = 0; i < 100; ++i)
        one.push_back({.id = i, .kind = LightKind::Point});   // around the receiver
    for (const Draw& draw : draws(one)) ASSERT_NEAR(draw.chance, 0.01f, 1e-4f);
    const std::vector<Light> decades{
        {.id = 0, .kind = LightKind::Point, .position = {0, 3, 0}, .emission = {1e-20f, 1e-20f, 1e-20f}},
        {.id = 1, .kind = LightKind::Point, .position = {0, 4, 0}, .emission = {1e20f, 1e20f, 1e20f}}};
    for (const Draw& draw : draws(decades)) ASSERT_EQ(draw.light, 1u);
    const std::vector<Light> far{{.id = 0, .kind = LightKind::Point, .position = {3e38f, 0, 0}},
                                 {.id = 1, .kind = LightKind::Point, .position = {-3e38f, 1, 0}}};
    for (const Draw& draw : draws(far)) ASSERT_TRUE(draw.light == kNone || draw.light < 2) << draw.light;
}

TEST_F(LightTree, SameLightsSameBits) {
    const std::vector<Light> lights = mixedLights(3000);
    const BuiltTable once = tests::build(lights), again = tests::build(lights, 0, 3);
    ASSERT_EQ(once.tree.size(), again.tree.size());
    const size_t unused = 2 * columnsOf(once) - 2;
    for (size_t i = 0; i < once.tree.size(); ++i) {
        if (i == unused) continue;
        ASSERT_EQ(std::memcmp(&once.tree[i], &again.tree[i], sizeof(uvec4)), 0) << i;
    }
}

}   // namespace
