#include <lights/alias.h>

#include <cmath>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include "support/statistics.h"

namespace {

using Weights = std::vector<double>;

double sum(const Weights& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

// Thresholds have 32 bits, and every column's rounding may go to the same light.
constexpr double kRounding = 1.0 / 4294967296.0;

void expectProbabilities(const Weights& weights) {
    const auto table = restir::makeAliasTable(weights);
    ASSERT_EQ(table.size(), weights.size());
    const Weights probabilities = restir::aliasProbabilities(table);
    EXPECT_NEAR(sum(probabilities), 1, 1e-12);
    const double total = sum(weights);
    for (size_t i = 0; i < weights.size(); ++i) {
        ASSERT_LT(table[i].alias, weights.size());
        EXPECT_NEAR(probabilities[i], weights[i] / total, kRounding) << "weight " << i;
        EXPECT_EQ(probabilities[i] > 0, weights[i] > 0) << "weight " << i;
    }
}

// As rsSampleLight draws.
uint32_t draw(std::span<const restir::gpu::RsAliasEntry> table, std::mt19937_64& random) {
    const uint64_t bits = random();
    const auto column = static_cast<uint32_t>((bits >> 32) * table.size() >> 32);
    const auto coin = static_cast<uint32_t>(bits);
    return coin < table[column].threshold ? column : table[column].alias;
}

TEST(AliasTable, MatchesWeights) {
    expectProbabilities({1, 1, 1, 1});
    expectProbabilities({1, 2, 3, 4, 5});
    expectProbabilities({0.1, 1e-3, 7, 1e4, 1e-7, 12});
    expectProbabilities({5});
}

TEST(AliasTable, OneLightIsAlwaysDrawn) {
    const auto table = restir::makeAliasTable(Weights{1e-30});
    EXPECT_EQ(restir::aliasProbabilities(table), Weights{1.0});
}

TEST(AliasTable, ZeroWeightsAreNeverDrawn) {
    expectProbabilities({0, 0, 1, 0, 2, 0});
    expectProbabilities({3, 0});
    expectProbabilities({0, 0, 0, 1e-30});
    Weights sparse(1000);
    sparse[17] = 1;
    sparse[900] = 3;
    expectProbabilities(sparse);
}

TEST(AliasTable, TinyBesideHugeCanBeDrawn) {
    const Weights weights{1e-20, 1e20, 1e-20, 0};
    const Weights probabilities = restir::aliasProbabilities(restir::makeAliasTable(weights));
    EXPECT_GT(probabilities[0], 0);
    EXPECT_GT(probabilities[2], 0);
    EXPECT_EQ(probabilities[3], 0);
    EXPECT_NEAR(probabilities[1], 1, 2 * kRounding);
}

TEST(AliasTable, NothingToDrawIsEmpty) {
    EXPECT_TRUE(restir::makeAliasTable(Weights{}).empty());
    EXPECT_TRUE(restir::makeAliasTable(Weights{0, 0, 0}).empty());
}

TEST(AliasTable, IsDeterministic) {
    const Weights weights{3, 1, 4, 1, 5, 9, 2, 6};
    const auto a = restir::makeAliasTable(weights), b = restir::makeAliasTable(weights);
    for (size_t i = 0; i < a.size(); ++i) {
        EXPECT_EQ(a[i].threshold, b[i].threshold);
        EXPECT_EQ(a[i].alias, b[i].alias);
    }
}

TEST(AliasTable, HundredThousandRandomWeights) {
    std::mt19937_64 random(1);
    std::exponential_distribution<double> heavy(1.0);
    Weights weights(100'000);
    for (size_t i = 0; i < weights.size(); ++i) weights[i] = i % 7 == 0 ? 0 : std::pow(heavy(random), 6);
    expectProbabilities(weights);
}

TEST(AliasTable, DrawsFollowTheWeights) {
    const Weights weights{10, 1, 0, 5, 0.2, 7, 7, 3, 0, 25};
    const auto table = restir::makeAliasTable(weights);
    std::mt19937_64 random(2);
    constexpr uint64_t kDraws = 2'000'000;
    std::vector<uint64_t> counts(weights.size());
    for (uint64_t i = 0; i < kDraws; ++i) ++counts[draw(table, random)];
    Weights probabilities = weights;
    for (double& p : probabilities) p /= sum(weights);
    EXPECT_LT(std::abs(tests::chiSquareZ(counts, probabilities, kDraws)), 4);
    // The same test sees two lights exchanged.
    std::swap(probabilities[5], probabilities[7]);
    EXPECT_GT(tests::chiSquareZ(counts, probabilities, kDraws), 20);
}

}   // namespace
