// The tests see the mistakes that the field makes. Each mutant of tests/mutants/mutations.cmake renders what
// the library renders, as many independent sequences of it, against a closed form: the library passes, the
// mutant must not.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <set>
#include <stdexcept>

#include <mutants.h>
#include <restir_embedded.h>

#include "image/host_view.h"
#include "image/hypothesis.h"
#include "image/plays.h"
#include "image/world.h"

namespace tests {
namespace {

using restir::VisibilityReuse;
using restir::Weights;

struct Trial {
    const char* name;
    Stage stage;
    uint32_t frames;
    uint32_t pictures;   // independent sequences
    restir::DiSettings di;
    std::vector<const char*> mutants;
    restir::GiSettings gi = {};

    friend std::ostream& operator<<(std::ostream& out, const Trial& trial) { return out << trial.name; }
};

const restir::DiSettings kSpatial{.lightCandidates = 2, .bsdfCandidates = 0, .temporal = false, .radius = 10};
const restir::DiSettings kTemporal{
    .lightCandidates = 2, .cutSamples = 1, .bsdfCandidates = 0, .maxHistory = 3, .spatialPasses = 0};

restir::DiSettings with(restir::DiSettings di, Weights weights, VisibilityReuse visibility) {
    di.weights = weights;
    di.visibility = visibility;
    return di;
}
restir::DiSettings withDirections(restir::DiSettings di, uint32_t lights, uint32_t directions) {
    di.lightCandidates = lights;
    di.bsdfCandidates = directions;
    return di;
}
restir::DiSettings withRounds(restir::DiSettings di, uint32_t rounds) {
    di.initialSamples = rounds;
    return di;
}
restir::DiSettings withSpatial(restir::DiSettings di) {
    di.spatialPasses = 1;
    di.radius = kSpatial.radius;
    return di;
}
restir::DiSettings alone(restir::DiSettings di) {
    di.temporal = false;
    di.spatialPasses = 0;
    return di;
}

template <class S>
S inPairs(S s) {
    s.pairedNeighbours = true;
    return s;
}

restir::DiSettings byPower(restir::DiSettings di) {
    di.treeShare = 0;
    return di;
}

const restir::GiSettings kPaths{
    .mode = restir::IndirectMode::Restir, .bounces = 2, .temporal = false, .radius = 10};

std::vector<Trial> trials() {
    const auto none = VisibilityReuse::None, traced = VisibilityReuse::Traced;
    const auto pairwise = Weights::Pairwise;
    const auto shadows = Stage::Shadows, near = Stage::NearShadows;
    return {
        {"candidates",
         near,
         1,
         64,
         byPower(alone(withDirections(with(kSpatial, pairwise, none), 2, 4))),
         {"misses_not_counted", "bsdf_density_without_count", "mixed_measures", "light_drawn_off_its_pdf",
          "coin_reused"}},
        {"candidates, from both sources",
         near,
         1,
         64,
         alone(withDirections(with(kSpatial, pairwise, none), 2, 4)),
         {"each_source_by_itself", "directions_forget_the_tree"}},
        {"candidates, for the receiver",
         Stage::Ball,
         1,
         64,
         alone(withDirections(with(kSpatial, pairwise, none), 2, 1)),
         {"receivers_density_missing"}},
        {"candidates in rounds",
         near,
         1,
         64,
         alone(withRounds(withDirections(with(kSpatial, pairwise, none), 2, 4), 3)),
         {"one_round_counted"}},
        {"spatial, none",
         near,
         1,
         256,
         withDirections(with(kSpatial, pairwise, none), 1, 4),
         {"bsdf_share_without_visibility", "final_ray_missing"}},
        {"spatial, pairwise traced",
         shadows,
         1,
         64,
         with(kSpatial, pairwise, traced),
         {"empty_is_rejected", "off_labelled_pairwise", "undefined_shift_skipped",
          "neighbours_visibility_missing", "canonical_visibility_missing", "defensive_part_unscaled",
          "larger_weight_wins"}},
        {"spatial, pairs traced",
         shadows,
         1,
         128,
         inPairs(with(kSpatial, pairwise, traced)),
         {"partner_without_the_sample_skipped", "notes_without_visibility"}},
        {"spatial, balance traced",
         shadows,
         1,
         64,
         with(kSpatial, Weights::Balance, traced),
         {"balance_without_source_target"}},
        {"spatial, basic traced",
         shadows,
         1,
         64,
         with(kSpatial, Weights::Basic, traced),
         {"basic_counts_everyone"}},
        {"temporal, traced",
         shadows,
         4,
         64,
         with(kTemporal, pairwise, traced),
         {"survivors_counted", "confidence_from_weight"}},
        {"temporal and spatial, none",
         shadows,
         4,
         64,
         withSpatial(with(kTemporal, pairwise, none)),
         {"final_ray_written_back"}},
        {"temporal, changes",
         Stage::Changes,
         6,
         64,
         with(kTemporal, pairwise, none),
         {"current_lights_in_history", "current_camera_in_history", "appeared_light_in_history",
          "growth_without_jacobian", "cap_after_s"}},
        {"paths, spatial",
         Stage::Card,
         1,
         64,
         alone(withDirections(kSpatial, 16, 0)),
         {"jacobian_left_out", "jacobian_inverted", "cosine_at_the_wrong_vertex"},
         kPaths},
        {"paths, pairs",
         Stage::Card,
         1,
         64,
         alone(withDirections(kSpatial, 16, 0)),
         {"jacobian_left_out_between_partners"},
         inPairs(kPaths)},
    };
}

// The library's passes, but for those of which there is a file in the mutant's directory.
class Pack {
public:
    explicit Pack(const MutantRow& mutant)
        : modules_(kEmbeddedPack.modules.begin(), kEmbeddedPack.modules.end()) {
        for (const char* pass : mutant.passes)
            if (pass) replace(pass, std::string(kMutantsDir) + "/" + mutant.name + "/" + pass + ".spv");
        pack_ = {RESTIR_SHADER_ABI, modules_};
    }
    const restir::ShaderPack& get() const { return pack_; }

private:
    void replace(const char* pass, const std::string& path) {
        std::ifstream file(path, std::ios::binary | std::ios::ate);
        std::vector<uint32_t>& words = words_.emplace_back(size_t(file.tellg()) / sizeof(uint32_t));
        file.seekg(0);
        file.read(reinterpret_cast<char*>(words.data()), std::streamsize(words.size() * sizeof(uint32_t)));
        const auto module = std::find_if(modules_.begin(), modules_.end(),
                                         [&](const auto& m) { return !std::strcmp(m.pass, pass); });
        if (!file || module == modules_.end()) throw std::runtime_error("no such mutant: " + path);
        *module = {module->pass, words.data(), words.size()};
    }

    std::vector<restir::ShaderPack::Module> modules_;
    std::vector<std::vector<uint32_t>> words_;
    restir::ShaderPack pack_;
};

SeedStatistics render(const Play& play, const Trial& trial, const restir::ShaderPack* shaders) {
    HostView host(*play.scene, play.view,
                  {.maxExtent = Play::kExtent,
                   .maxLights = 8,
                   .pairedNeighbours = restir::kPresetPartners,
                   .indirect = trial.gi.mode != restir::IndirectMode::Off,
                   .shaders = shaders});
    restir::Settings settings;
    settings.di = trial.di;
    settings.gi = trial.gi;
    SeedStatistics statistics;
    for (uint32_t seed = 1; seed <= trial.pictures; ++seed) {
        for (uint32_t frame = 0; frame < trial.frames; ++frame) {
            play.setUp(host, frame, trial.frames);
            restir::FrameInput input = host.input(frame);
            input.seed = seed;
            input.resetHistory = frame == 0;
            const samples::FloatImage image = host.frame(input, settings);
            if (frame + 1 == trial.frames) statistics.add(image);
        }
    }
    return statistics;
}

// The largest |z| of all blocks and channels, and the bias of the channel that is furthest out.
struct Finding {
    double z = 0, bias = 0, error = 0;
    size_t cells = 0;
};
Finding finding(const SeedStatistics& statistics, const ReferenceBlocks& truth) {
    const Agreement a = compare(statistics, truth);
    Finding f{.cells = a.blocks + 3};
    double most = 0;
    for (size_t c = 0; c < 3; ++c) {
        const double z = std::abs(a.channelRatio[c]) / a.channelError[c];
        if (z < most) continue;
        most = z;
        f.bias = a.channelRatio[c];
        f.error = a.channelError[c];
    }
    f.z = std::max(most, a.worstZ);
    return f;
}
void print(const char* name, const Finding& f, double bound) {
    std::printf("%-32s bias %+7.2f %% (s.e. %.2f)  worst |z| %6.1f of %.1f\n", name, 100 * f.bias,
                100 * f.error, f.z, bound);
    std::fflush(stdout);
}

class Mutants : public testing::TestWithParam<Trial> {};

TEST_P(Mutants, AreCaught) {
    if (!device().hasRayQuery()) GTEST_SKIP() << "mutants are compiled for ray query";
    const Trial& trial = GetParam();
    const Play& rendered = play(trial.stage);
    const ReferenceBlocks truth = exactly(rendered.truth());
    const Finding library = finding(render(rendered, trial, nullptr), truth);
    const double bound = studentBound(library.cells * trials().size(), trial.pictures);
    print(trial.name, library, bound);
    EXPECT_LE(library.z, bound);
    for (const char* name : trial.mutants) {
        const auto row = std::find_if(std::begin(kMutants), std::end(kMutants),
                                      [&](const MutantRow& m) { return !std::strcmp(m.name, name); });
        ASSERT_NE(row, std::end(kMutants)) << name << " is not in tests/mutants/mutations.cmake";
        const Pack pack(*row);
        const Finding mutant = finding(render(rendered, trial, &pack.get()), truth);
        print(name, mutant, bound);
        EXPECT_GT(mutant.z, bound) << name << ": " << row->mistake;
    }
}
INSTANTIATE_TEST_SUITE_P(All, Mutants, testing::ValuesIn(trials()), [](const auto& trial) {
    std::string name;
    for (const char* c = trial.param.name; *c; ++c)
        if (std::isalnum(static_cast<unsigned char>(*c))) name += *c;
    return name;
});

TEST(MutantsList, EachIsInOneTrial) {
    std::multiset<std::string> tried;
    for (const Trial& trial : trials()) tried.insert(trial.mutants.begin(), trial.mutants.end());
    for (const MutantRow& mutant : kMutants) EXPECT_EQ(tried.count(mutant.name), 1u) << mutant.name;
    EXPECT_EQ(tried.size(), std::size(kMutants));
}

}   // namespace
}   // namespace tests
