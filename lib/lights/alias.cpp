#include <lights/alias.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace restir {
namespace {

constexpr double kFull = 4294967296.0;

uint32_t thresholdOf(double share) {
    return uint32_t(std::clamp(std::round(share * kFull), 1.0, kFull - 1));
}

}   // namespace

std::vector<gpu::RsAliasEntry> makeAliasTable(std::span<const double> weights) {
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    if (!(sum > 0)) return {};
    const double scale = double(weights.size()) / sum;
    const auto heaviest = uint32_t(std::max_element(weights.begin(), weights.end()) - weights.begin());

    std::vector<double> share(weights.size());   // of one column; 1 fills it
    std::vector<uint32_t> small, large;
    for (uint32_t i = 0; i < weights.size(); ++i) {
        share[i] = weights[i] * scale;
        (share[i] < 1 ? small : large).push_back(i);
    }
    std::vector<gpu::RsAliasEntry> table(weights.size());
    auto settle = [&](uint32_t i, uint32_t alias) {
        table[i] = {.threshold = weights[i] > 0 ? thresholdOf(share[i]) : 0, .alias = alias};
    };
    while (!small.empty() && !large.empty()) {
        const uint32_t s = small.back(), l = large.back();
        small.pop_back();
        settle(s, l);
        share[l] -= 1 - share[s];
        if (share[l] < 1) {
            large.pop_back();
            small.push_back(l);
        }
    }
    // What is left is full but for rounding.
    for (const auto* rest : {&small, &large})
        for (uint32_t i : *rest) settle(i, weights[i] > 0 ? i : heaviest);
    return table;
}

std::vector<double> aliasProbabilities(std::span<const gpu::RsAliasEntry> table) {
    std::vector<double> probability(table.size());
    const double column = 1.0 / double(table.size());
    for (size_t i = 0; i < table.size(); ++i) {
        const double keep = table[i].threshold / kFull;
        probability[i] += column * keep;
        probability[table[i].alias] += column * (1 - keep);
    }
    return probability;
}

}   // namespace restir
