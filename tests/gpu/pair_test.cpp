// Partners: that they are, where they lie, and that both agree to be.
#include <cmath>

#include <glm/glm.hpp>

#include <restir/shared/di.h>

#include "pair.spv.h"
#include "support/gpu.h"
#include "support/statistics.h"

namespace {

using namespace restir::gpu;

constexpr uint32_t kWidth = 101, kHeight = 83, kPixels = kWidth * kHeight;

struct Parameters {
    RsDiConstants di{.neighbours = 5, .normalThreshold = 0.9f, .depthThreshold = 0.1f, .partnerSquare = 36};
    uvec2 extent{kWidth, kHeight};
    uint32_t job = 0, seed = 0, stage = 2, index = 0;

    uint32_t notes() const { return 1 + di.neighbours; }
};

struct Result {
    std::vector<glm::ivec4> partners;
    std::vector<uint32_t> notes;
};

Result run(const Parameters& p) {
    static const tests::Kernel kernel(k_pair_spv, 3);
    Result result{std::vector<glm::ivec4>(kPixels), std::vector<uint32_t>(kPixels * p.notes())};
    kernel.run((kPixels + 63) / 64, {tests::in(std::vector<Parameters>{p}), tests::out(result.partners),
                                     tests::out(result.notes)});
    return result;
}

class Pair : public tests::GpuTest {};

TEST_F(Pair, PartnerOfThePartnerIsThePixel) {
    for (uint32_t square : {2u, 4u, 8u, 36u, 62u})
        for (uint32_t seed : {1u, 2u, 0x9e3779b9u})
            for (uint32_t index = 0; index < 16; ++index) {
                Parameters p{.seed = seed, .stage = 2 + index % 3, .index = index};
                p.di.partnerSquare = square;
                for (const glm::ivec4& d : run(p).partners) {
                    ASSERT_TRUE(d.z == 0 && d.w == 0) << square << ": " << d.z << ", " << d.w << " off";
                    ASSERT_TRUE(d.x != 0 || d.y != 0);
                    ASSERT_LT(std::max(std::abs(d.x), std::abs(d.y)), int(square));
                }
            }
}

// Two points of a square: no direction is preferred, the mean square is n^2 / 3. The next pixel's has nothing
// to do with it.
TEST_F(Pair, PartnersLieAllOverTheSquare) {
    std::vector<double> x, y, squares, besides;
    for (uint32_t seed = 0; seed < 64; ++seed) {
        const std::vector<glm::ivec4> partners = run({.seed = seed, .index = seed % 7}).partners;
        for (uint32_t i = 0; i + 1 < kPixels; ++i) {
            const glm::dvec2 d(partners[i].x, partners[i].y), next(partners[i + 1].x, partners[i + 1].y);
            x.push_back(d.x);
            y.push_back(d.y);
            squares.push_back(dot(d, d));
            besides.push_back(dot(d, next));
        }
    }
    EXPECT_LT(std::abs(tests::meanOf(x).mean), 0.1);
    EXPECT_LT(std::abs(tests::meanOf(y).mean), 0.1);
    EXPECT_NEAR(tests::meanOf(squares).mean, 36 * 36 / 3.0, 4);
    // Nothing but the place in the square is common to both, n^2 / 6 if they are in one. One displacement:
    // n^2 / 3.
    EXPECT_LT(tests::meanOf(besides).mean, 36 * 36 / 6.0);
}

TEST_F(Pair, BothAgreeOnBeingPartners) {
    uint32_t agreed = 0, refused = 0;
    for (uint32_t neighbours : {1u, 2u, 5u}) {
        for (uint32_t index = 0; index < neighbours; ++index) {
            Parameters p{.job = 1, .seed = 5, .index = index};
            p.di.neighbours = neighbours;
            const Result r = run(p);
            const auto noteOf = [&](uint32_t pixel) { return r.notes[pixel * p.notes() + 1 + index]; };
            for (uint32_t i = 0; i < kPixels; ++i) {
                const glm::ivec2 at(r.partners[i].x, r.partners[i].y);
                if (at.x < 0 || at.y < 0 || at.x >= int(kWidth) || at.y >= int(kHeight)) {
                    ASSERT_EQ(noteOf(i), 0x8000u);
                    continue;
                }
                const uint32_t theirs = noteOf(uint32_t(at.y) * kWidth + uint32_t(at.x));
                ASSERT_EQ(noteOf(i), theirs) << "no lights: nothing but acceptance is noted";
                ++(theirs == 0 ? agreed : refused);
            }
        }
    }
    EXPECT_GT(agreed, refused / 10);
    EXPECT_GT(refused, agreed / 10);
}

}   // namespace
