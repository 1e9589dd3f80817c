// The bias table's machinery on a handful of its cells: what restir-bench bias does at length.
#include <gtest/gtest.h>

#include <filesystem>
#include <random>

#include <proof/run.h>
#include <proof/summary.h>

#include "image/world.h"

namespace tests {
namespace {

constexpr uint32_t kSide = 32;
// Short histories within a few pixels: more independent samples in a picture.
const char* const kNear = " radius=6 max-history=5";

class Bias : public testing::Test {
protected:
    void SetUp() override {
        directory_ = std::filesystem::temp_directory_path() /
                     ("restir-bias-" + std::to_string(std::random_device()()));
        std::filesystem::create_directories(directory_);
        prover_ = std::make_unique<Prover>(device(), samples::makeBuiltin("cornell"),
                                           VkExtent2D{kSide, kSide}, restir::SessionDesc{});
    }
    void TearDown() override { std::filesystem::remove_all(directory_); }
    std::string path(const char* name) const { return (directory_ / name).string(); }

    Plan plan(std::vector<std::string> scenarios, std::vector<std::string> rows, size_t sequences) const {
        Plan plan{.scene = "builtin:cornell", .extent = {kSide, kSide}, .limits = {.sequences = sequences}};
        plan.reference = {.sequences = 24, .paths = 96};
        for (const std::string& name : scenarios) {
            plan.scenarios.push_back(findScenario(name));
            plan.scenarios.back().frames = 10;
            plan.scenarios.back().warmUp = 6;
        }
        for (const std::string& row : rows) plan.rows.push_back(parseRow(row + kNear));
        return plan;
    }
    void run(const Plan& plan, ProofFile& file) {
        proof::run(plan, file, *prover_, [](const std::string&) {});
    }

    std::filesystem::path directory_;
    std::unique_ptr<Prover> prover_;
};

TEST_F(Bias, TellsRightFromWrong) {
    ProofFile file(path("bias.json"));
    run(plan({"static", "camera"}, {"pairwise-traced="}, 48), file);
    run(plan({"static"}, {"cached=visibility=cached"}, 48), file);   // wrong, and as quiet
    const Table table = tabulate(file, 0.015);
    std::printf("%s", biasTable(table).c_str());
    ASSERT_EQ(table.summaries.size(), 1u);
    for (const SummaryRow& row : table.summaries[0].rows) {
        SCOPED_TRACE(row.name);
        if (row.name != "cached") {
            EXPECT_EQ(row.verdict, proof::Verdict::Unbiased);
            continue;
        }
        const Agreement& a = row.entries.at("static").judgement.agreement;
        EXPECT_EQ(row.verdict, proof::Verdict::Biased);
        // -4.6 %, standard error 0.35 %, when this was written.
        EXPECT_LE(a.luminanceRatio.mean, -8 * a.luminanceRatio.error);
        EXPECT_LE(a.luminanceRatio.mean, -0.03);
        EXPECT_GE(a.luminanceRatio.mean, -0.065);
    }
}

TEST_F(Bias, GoesOnAfterABreak) {
    ProofFile once(path("once.json")), first(path("twice.json"));
    Plan small = plan({"camera"}, {"row="}, 8);
    small.reference = {.sequences = 8, .paths = 4};
    run(small, once);
    small.limits.sequences = 4;
    run(small, first);
    ProofFile second(path("twice.json"));
    ASSERT_EQ(second.cells.at(0).sequences(), 4u);
    small.limits.sequences = 8;
    run(small, second);
    EXPECT_EQ(second.cells.at(0).mean.sums().products, once.cells.at(0).mean.sums().products);
    EXPECT_EQ(second.cells.at(0).last.sums().channels, once.cells.at(0).last.sums().channels);
    EXPECT_EQ(second.cells.at(0).meanPicture.rgb, once.cells.at(0).meanPicture.rgb);
    EXPECT_EQ(second.cells.at(0).noise.products(), once.cells.at(0).noise.products());
}

TEST_F(Bias, OtherSettingsAndCommitsAreRefused) {
    ProofFile file(path("stale.json"));
    Plan small = plan({"static"}, {"row="}, 4);
    small.reference = {.sequences = 4, .paths = 4};
    run(small, file);
    Plan other = small;
    other.rows[0].settings += " candidates=8";
    EXPECT_THROW(run(other, file), std::runtime_error);
    other.stale = Stale::Redo;
    run(other, file);
    EXPECT_EQ(file.cells.at(0).subject.settings, other.rows[0].settings);
    EXPECT_EQ(file.cells.at(0).sequences(), 4u);

    file.cells.at(0).commit = "older";
    other.stale = Stale::Refuse;
    other.limits.sequences = 6;
    EXPECT_THROW(run(other, file), std::runtime_error);
    other.stale = Stale::Keep;
    run(other, file);
    EXPECT_EQ(file.cells.at(0).commit, std::string("older+") + builtCommit());
    EXPECT_EQ(file.cells.at(0).sequences(), 6u);
}

}   // namespace
}   // namespace tests
