// The fuzz targets without a fuzzer: their seeds, and some bytes changed at random. Under the sanitizers it
// is worth more.
#include <random>

#include <gtest/gtest.h>

#include "fuzz/target.h"

namespace {

constexpr int kChanges = 40;   // of each seed

class Fuzz : public testing::TestWithParam<const fuzz::Target*> {};

TEST_P(Fuzz, SeedsAndTheirNeighbours) {
    std::mt19937 random(1);
    for (const fuzz::Bytes& seed : GetParam()->seeds()) {
        GetParam()->run(seed);
        for (int i = 0; i < kChanges; ++i) {
            fuzz::Bytes changed = seed;
            for (int edit = 0; edit < 3 && !changed.empty(); ++edit)
                changed[random() % changed.size()] = uint8_t(random());
            GetParam()->run(changed);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Targets, Fuzz, testing::Values(RESTIR_FUZZ_TARGETS),
                         [](const auto& target) { return std::string(target.param->name); });

}   // namespace
