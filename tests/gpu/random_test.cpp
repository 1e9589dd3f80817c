// Random numbers and draws from the alias table, as the passes make them.
#include <array>
#include <bit>
#include <cmath>
#include <numeric>

#include "gpu/built_table.h"
#include "random.spv.h"
#include "support/gpu.h"
#include "support/statistics.h"

namespace {

using restir::gpu::RsAliasEntry;
using restir::gpu::uvec4;

constexpr uint32_t kWidth = 512, kPixels = kWidth * kWidth;
constexpr uint32_t kIndices = 13;

std::vector<uvec4> run(std::array<uint32_t, 4> parameters, const std::vector<RsAliasEntry>& table) {
    static const tests::Kernel kernel(k_random_spv, 3);
    std::vector<uvec4> results(kPixels);
    kernel.run(kPixels / 64, {tests::in(std::vector<uint32_t>(parameters.begin(), parameters.end())),
                              tests::in(table), tests::out(results)});
    return results;
}

std::vector<uvec4> streams(uint32_t seed, uint32_t stage) {
    return run({0, seed, stage, kIndices}, std::vector<RsAliasEntry>(1));
}

double unit(uint32_t bits) { return bits / 4294967296.0; }

double uniformZ(const std::vector<uint64_t>& counts) {
    const std::vector<double> equal(counts.size(), 1.0 / static_cast<double>(counts.size()));
    return tests::chiSquareZ(counts, equal, std::accumulate(counts.begin(), counts.end(), uint64_t{0}));
}

// Of pairs of numbers that should have nothing to do with one another: over a 32 x 32 grid, and their
// correlation in standard errors.
struct Independence {
    double chi = 0, correlation = 0;
};
template <class First, class Second>
Independence independence(const First& first, const Second& second, uint32_t pairs) {
    std::vector<uint64_t> counts(32 * 32);
    double sum = 0;
    for (uint32_t i = 0; i < pairs; ++i) {
        const uint32_t a = first(i), b = second(i);
        ++counts[(a >> 27) * 32 + (b >> 27)];
        sum += (unit(a) - 0.5) * (unit(b) - 0.5);
    }
    return {uniformZ(counts), sum * 12 / std::sqrt(double(pairs))};
}
void expectIndependent(const Independence& found, const char* what) {
    EXPECT_LT(std::abs(found.chi), 4.5) << what;
    EXPECT_LT(std::abs(found.correlation), 4.5) << what;
}

class Random : public tests::GpuTest {};

TEST_F(Random, IsUniform) {
    for (uint32_t seed : {0u, 1u, 0x9e3779b9u}) {
        std::vector<uint64_t> high(256), low(256), indices(kIndices);
        double sum = 0;
        for (const uvec4& r : streams(seed, 1)) {
            ++high[r.x >> 24];
            ++low[r.y & 255u];
            ASSERT_LT(r.z, kIndices);
            ++indices[r.z];
            const float f = std::bit_cast<float>(r.w);
            ASSERT_TRUE(f >= 0 && f < 1);
            sum += double(f);
        }
        EXPECT_LT(std::abs(uniformZ(high)), 4.5);
        EXPECT_LT(std::abs(uniformZ(low)), 4.5);
        EXPECT_LT(std::abs(uniformZ(indices)), 4.5);
        EXPECT_LT(std::abs(sum / kPixels - 0.5) * std::sqrt(12.0 * kPixels), 4.5);
    }
}

TEST_F(Random, NeighboursStagesAndFramesAreIndependent) {
    const std::vector<uvec4> here = streams(7, 0), stage = streams(7, 1), frame = streams(8, 0);
    const auto first = [&](uint32_t i) { return here[i].x; };
    expectIndependent(independence(
                          first, [&](uint32_t i) { return here[i].y; }, kPixels),
                      "the next number");
    expectIndependent(independence(
                          first, [&](uint32_t i) { return here[i + 1].x; }, kPixels - 1),
                      "the next pixel");
    expectIndependent(independence(
                          first, [&](uint32_t i) { return here[i + kWidth].x; }, kPixels - kWidth),
                      "the next row");
    expectIndependent(independence(
                          first, [&](uint32_t i) { return here[i + kWidth + 1].x; }, kPixels - kWidth - 1),
                      "the diagonal");
    expectIndependent(independence(
                          first, [&](uint32_t i) { return stage[i].x; }, kPixels),
                      "the next stage");
    expectIndependent(independence(
                          first, [&](uint32_t i) { return frame[i].x; }, kPixels),
                      "the next frame");
    expectIndependent(independence(
                          first, [&](uint32_t i) { return frame[i].y; }, kPixels),
                      "the next frame's second");
    // The same test sees a stream beside itself.
    EXPECT_GT(independence(first, first, kPixels).correlation, 100);
}

TEST_F(Random, SameSeedSameBits) {
    const std::vector<uvec4> a = streams(3, 2), b = streams(3, 2);
    for (uint32_t i = 0; i < kPixels; ++i)
        ASSERT_TRUE(a[i].x == b[i].x && a[i].y == b[i].y && a[i].w == b[i].w);
}

// As many as a power of two, one more, few, one, and more than a block of the table's.
TEST_F(Random, LightsAreDrawnByTheirSelection) {
    for (uint32_t count : {37u, 64u, 65u, 2u, 1u, 1300u}) {
        std::vector<restir::Light> lights;
        for (uint32_t i = 0; i < count; ++i) {
            restir::Light light{.id = i, .kind = restir::LightKind::Point};
            for (float& e : light.emission) e = i % 5 == 1 ? 0 : std::pow(1.3f, float(i % 11));
            lights.push_back(light);
        }
        const tests::BuiltTable table = tests::build(lights);
        std::vector<double> selection;
        for (const auto& light : table.lights) selection.push_back(double(light.selection));
        std::vector<uint64_t> counts(count);
        for (const uvec4& r : run({1, 11, 0, count}, table.alias))
            for (uint32_t id : {r.x, r.y, r.z, r.w}) {
                ASSERT_LT(id, count);
                ++counts[id];
            }
        if (count == 1) EXPECT_EQ(counts[0], uint64_t{4} * kPixels);
        else EXPECT_LT(std::abs(tests::chiSquareZ(counts, selection, uint64_t{4} * kPixels)), 4.5) << count;
    }
}

}   // namespace
