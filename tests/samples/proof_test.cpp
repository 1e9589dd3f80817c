// The proof harness on pictures whose bias is known, because the test made it.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <set>
#include <sstream>

#include <proof/run.h>
#include <proof/student.h>
#include <proof/summary.h>

namespace tests {
namespace {

using namespace proof;
using samples::FloatImage;

constexpr uint32_t kSide = 64;

// Pictures that spatial reuse might have made: noise of each pixel, of each quarter of the picture, and of
// the whole.
class Source {
public:
    explicit Source(uint32_t seed, double pixel = 0.2, double shared = 0.05)
        : random_(seed), pixel_(pixel), shared_(shared) {}

    // `bias` is relative, at a pixel.
    template <class Bias>
    FloatImage picture(const Bias& bias) {
        FloatImage image{kSide, kSide, {}};
        const double whole = shared_ * normal_(random_);
        double quarter[4];
        for (double& value : quarter) value = shared_ * normal_(random_);
        for (uint32_t y = 0; y < kSide; ++y) {
            for (uint32_t x = 0; x < kSide; ++x) {
                const double noise = whole + quarter[y / 32 * 2 + x / 32] + pixel_ * normal_(random_);
                for (double truth : {1.0, 2.0, 0.5})
                    image.rgb.push_back(float(truth * (1 + bias(x, y)) * (1 + noise)));
            }
        }
        return image;
    }
    FloatImage picture(double bias = 0) {
        return picture([=](uint32_t, uint32_t) { return bias; });
    }
    Take take(double bias = 0) { return {.mean = picture(bias), .end = {picture(bias), picture(bias)}}; }

private:
    std::mt19937 random_;
    std::normal_distribution<double> normal_;
    double pixel_, shared_;
};

ReferenceBlocks truth() {
    FloatImage image{kSide, kSide, {}};
    for (uint32_t i = 0; i < kSide * kSide; ++i) image.rgb.insert(image.rgb.end(), {1.0f, 2.0f, 0.5f});
    return exactly(image);
}

SeedStatistics pictures(Source& source, uint32_t count, double bias) {
    SeedStatistics statistics;
    for (uint32_t i = 0; i < count; ++i) statistics.add(source.picture(bias));
    return statistics;
}

TEST(Proof, StudentQuantiles) {   // from tables, and by another integration
    EXPECT_NEAR(studentQuantile(0.05, 1), 12.706, 1e-3);
    EXPECT_NEAR(studentQuantile(0.05, 10), 2.2281, 1e-4);
    EXPECT_NEAR(studentQuantile(0.001, 30), 3.6460, 1e-4);
    EXPECT_NEAR(studentQuantile(0.05, 1e7), 1.95996, 1e-4);
    EXPECT_NEAR(studentQuantile(0.05, 2.5), 3.5747, 1e-4);   // between those of 2 and 3 degrees
    EXPECT_NEAR(studentQuantile(1e-7, 200), 5.5287, 1e-4);
}

TEST(Proof, IntervalsCoverAndSpreadsAreRight) {
    constexpr uint32_t kRuns = 200, kPictures = 24;
    const ReferenceBlocks reference = truth();
    Source source(1);
    uint32_t covered = 0;
    double sum = 0, squares = 0, spread = 0;
    for (uint32_t run = 0; run < kRuns; ++run) {
        const Agreement a = compare(pictures(source, kPictures, 0.03), reference);
        if (std::abs(a.luminanceRatio.mean - 0.03) <= a.halfWidth) ++covered;
        const Agreement null = compare(pictures(source, kPictures, 0), reference);
        const double value = judge(null, kPictures - 1, {}).meanSquare;
        sum += value / kRuns;
        squares += value * value / kRuns;
        spread += null.meanSquareZSpread / kRuns;
    }
    EXPECT_NEAR(covered, 0.95 * kRuns, 3.3 * std::sqrt(0.05 * 0.95 * kRuns));
    EXPECT_NEAR(sum, 1, 0.12);
    // The spread of 64 independent blocks would be 0.18.
    EXPECT_GT(spread, 0.5);
    EXPECT_NEAR(std::sqrt(squares - sum * sum) / spread, 1, 0.3);
}

TEST(Proof, AnUncertainReferenceWidensTheInterval) {
    Source source(2);
    const SeedStatistics estimate = pictures(source, 200, 0);
    const Agreement against = compare(estimate, referenceFromSeeds(pictures(source, 16, 0)));
    const Agreement exact = compare(estimate, truth());
    EXPECT_GT(against.halfWidth, 2 * exact.halfWidth);
    EXPECT_LT(against.luminanceRatio.freedom, 30);   // the reference's 15 and some
    EXPECT_NE(judge(against, 199, {.hypotheses = 69}).verdict, Verdict::Biased);
}

TEST(Proof, SequencesThatAHalfWidthNeeds) {
    Source source(8);
    const SeedStatistics some = pictures(source, 40, 0), reference = pictures(source, 2000, 0);
    const double halfWidth = compare(some, referenceFromSeeds(reference)).halfWidth;
    EXPECT_NEAR(sequencesFor(halfWidth / 2, some, reference), 4 * 40, 0.15 * 4 * 40);
    EXPECT_TRUE(std::isinf(sequencesFor(halfWidth / 100, some, reference)));
}

TEST(Proof, VerdictsOnSyntheticBias) {
    constexpr uint32_t kPictures = 400;
    const Bounds bounds{.hypotheses = 69 * 12, .halfWidth = 0.01};
    const auto verdict = [&](const SeedStatistics& s, const Bounds& b) {
        return judge(compare(s, truth()), double(s.pictures()) - 1, b).verdict;
    };
    Source source(3);
    const SeedStatistics right = pictures(source, kPictures, 0);
    EXPECT_EQ(verdict(right, bounds), Verdict::Unbiased);
    EXPECT_EQ(verdict(right, {.hypotheses = 69 * 12, .halfWidth = 0.001}), Verdict::Open);
    EXPECT_EQ(verdict(pictures(source, kPictures, -0.03), bounds), Verdict::Biased);
    SeedStatistics local;   // a single block, by 4 %: the mean does not tell
    for (uint32_t i = 0; i < kPictures; ++i)
        local.add(source.picture([](uint32_t x, uint32_t y) { return x < 8 && y >= 56 ? 0.04 : 0.0; }));
    EXPECT_EQ(verdict(local, bounds), Verdict::Biased);
    SeedStatistics checkered;   // every block by less than its z shows: the mean of z^2 does
    Source quiet(4, 0.2, 0);
    for (uint32_t i = 0; i < kPictures; ++i)
        checkered.add(
            quiet.picture([](uint32_t x, uint32_t y) { return (x / 8 + y / 8) % 2 == 0 ? 0.002 : -0.002; }));
    const Agreement a = compare(checkered, truth());
    EXPECT_LT(a.worstZ, studentBound(bounds.hypotheses, kPictures - 1));
    EXPECT_EQ(verdict(checkered, bounds), Verdict::Biased);
}

TEST(Proof, MeanSquareIsJudgedByItsOwnSpread) {
    Agreement a{.meanSquareZ = 1.6, .meanSquareZSpread = 0.4, .blocks = 64};
    EXPECT_EQ(judge(a, 1e6, {.hypotheses = 69}).verdict, Verdict::Unbiased);   // a sigma and a half
    a.meanSquareZSpread = 0.14;
    EXPECT_EQ(judge(a, 1e6, {.hypotheses = 69}).verdict, Verdict::Open);   // four
    a.meanSquareZSpread = 0.1;
    EXPECT_EQ(judge(a, 1e6, {.hypotheses = 69}).verdict, Verdict::Biased);
    a.meanSquareZ = 1.19;
    a.meanSquareZSpread = 0.01;
    EXPECT_EQ(judge(a, 1e6, {.hypotheses = 69}).verdict, Verdict::Unbiased);
    a.worstZ = 9;
    EXPECT_EQ(judge(a, 1e6, {.hypotheses = 69}).verdict, Verdict::Biased);
    a.worstZ = 0;
    a.channelRatio[2] = 0.01;
    a.channelError[2] = 0.001;
    EXPECT_EQ(judge(a, 1e6, {.hypotheses = 69}).verdict, Verdict::Biased);
}

// A mean of 1 that a picture in fifty brings up to it: for a while it looks too dark.
TEST(Proof, RareOutliersAreNotCalledBias) {
    Source source(9, 0.2, 0);
    SeedStatistics rare;
    for (uint32_t i = 1; i <= 60; ++i) rare.add(source.picture(i % 50 == 0 ? 0.49 : -0.01));
    const Judgement early = judge(compare(rare, truth()), 59, {.hypotheses = 69});
    EXPECT_EQ(early.verdict, Verdict::Open);
    EXPECT_GT(early.sequencesNeeded, 60);
}

TEST(Proof, OutliersAreLeftOutOfTheTrimmedError) {
    samples::FloatImage reference{10, 10, std::vector<float>(300, 1.0f)}, image = reference;
    for (float& v : image.rgb) v = 1.1f;
    for (size_t c = 0; c < 3; ++c) image.rgb[30 + c] = 101;   // one pixel of a hundred
    EXPECT_NEAR(relativeError(image, reference), (0.99 * 0.01 + 100) / 1.01, 0.01);
    EXPECT_NEAR(trimmedError(image, reference, 0.99), 0.01 / 1.01, 1e-6);
    EXPECT_EQ(trimmedError(image, reference, 1), relativeError(image, reference));
    for (size_t c = 0; c < 3; ++c) reference.rgb[c] = 0;   // not counted
    EXPECT_NEAR(trimmedError(image, reference, 0.98), 0.01 / 1.01, 1e-3);
    EXPECT_EQ(trimmedError(image, {10, 10, std::vector<float>(300)}, 0.99), 0);
}

TEST(Proof, NoiseOfTheReferenceIsNoError) {
    Source source(5, 0.2, 0);
    Reference reference;
    for (uint32_t i = 0; i < 16; ++i) reference.add(source.take(), source.take());
    Cell cell;
    Source other(6, 0.2, 0);
    for (uint32_t i = 0; i < 16; ++i) cell.add(other.take(), other.take(), reference);
    // The floor of 0.01 mean^2 under the luminance's square.
    EXPECT_NEAR(cell.relativeError(reference), 0.2 * 0.2 / 1.01, 0.001);
    EXPECT_NEAR(reference.noise(), 0.2 * 0.2 / 1.01 / 32, 0.0001);
}

TEST(Proof, CorrelationOfConsecutiveFrames) {
    Source source(7, 0.3, 0);
    const FloatImage reference = Source(0, 0, 0).picture();
    NoiseCorrelation none, whole, half;
    const auto mixed = [](const FloatImage& a, const FloatImage& b) {   // correlation with each 1 / sqrt(2)
        FloatImage image = a;
        for (size_t i = 0; i < a.rgb.size(); ++i) image.rgb[i] = (a.rgb[i] + b.rgb[i]) / std::sqrt(2.0f);
        return image;
    };
    for (uint32_t i = 0; i < 8; ++i) {
        // Two independent sequences, biased alike: the bias does not count.
        const FloatImage a = source.picture(0.5), b = source.picture(0.5), c = source.picture(0.5),
                         d = source.picture(0.5);
        none.add({a, b}, {c, d}, reference);
        whole.add({a, a}, {c, c}, reference);
        half.add({a, mixed(a, b)}, {c, mixed(c, d)}, reference);
    }
    EXPECT_NEAR(none.value(), 0, 0.02);
    EXPECT_NEAR(whole.value(), 1, 1e-6);
    EXPECT_NEAR(half.value(), std::sqrt(0.5), 0.02);
}

class ProofFiles : public testing::Test {
protected:
    void SetUp() override {
        directory_ = std::filesystem::temp_directory_path() /
                     ("restir-proof-" + std::to_string(std::random_device()()));
        std::filesystem::create_directories(directory_);
    }
    void TearDown() override { std::filesystem::remove_all(directory_); }
    std::string path(const std::string& name) const { return (directory_ / name).string(); }
    static std::string textOf(const std::string& file) {
        std::ifstream stream(file, std::ios::binary);
        std::stringstream text;
        text << stream.rdbuf();
        return text.str();
    }

    static Subject subject(const std::string& row) {
        return {.scene = "builtin:none",
                .width = kSide,
                .height = kSide,
                .scenario = "static",
                .frames = 3,
                .warmUp = 1,
                .row = row,
                .settings = row.empty() ? "" : "weights=off"};
    }
    // A reference, and `pairs` of sequences of a row from the `first` pair on.
    static void makeReference(ProofFile& file) {
        Source source(1);
        file.references.push_back({.subject = subject(""), .commit = "a"});
        for (uint32_t i = 0; i < 100; ++i) file.references[0].add(source.take(), source.take());
    }
    static void addPairs(ProofFile& file, const std::string& row, double bias, uint32_t first,
                         uint32_t pairs) {
        if (!file.findCell(subject(row))) file.cells.push_back({.subject = subject(row), .commit = "a"});
        for (uint32_t i = first; i < first + pairs; ++i) {
            Source source(100 + i);
            Cell& cell = *file.findCell(subject(row));
            cell.add(source.take(bias), source.take(bias), file.referenceOf(cell));
        }
    }

    std::filesystem::path directory_;
};

TEST_F(ProofFiles, GoingOnIsAsIfThereHadBeenNoBreak) {
    ProofFile once(path("once.json"));
    makeReference(once);
    addPairs(once, "row", 0, 0, 6);
    once.save();
    {
        ProofFile first(path("twice.json"));
        makeReference(first);
        addPairs(first, "row", 0, 0, 2);
        first.save();
    }
    ProofFile second(path("twice.json"));
    addPairs(second, "row", 0, 2, 4);
    second.save();
    EXPECT_EQ(textOf(path("twice.json")), textOf(path("once.json")));
    EXPECT_GT(textOf(path("once.json")).size(), 1000u);
    // Pictures of the break are gone, the last ones are there and the same.
    size_t files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(path("twice.json.pictures"))) {
        ++files;
        EXPECT_EQ(textOf(entry.path().string()),
                  textOf(path("once.json.pictures/" + entry.path().filename().string())));
    }
    EXPECT_EQ(files, 5u);
}

TEST_F(ProofFiles, TablesSayWhatIsBiased) {
    ProofFile file(path("table.json"));
    makeReference(file);
    addPairs(file, "right", 0, 0, 40);
    addPairs(file, "wrong", -0.2, 0, 40);
    addPairs(file, "young", 0, 0, 2);   // too few to be judged
    const Table table = tabulate(file, 0.02);
    ASSERT_EQ(table.summaries.size(), 1u);
    ASSERT_EQ(table.summaries[0].rows.size(), 2u);
    EXPECT_EQ(table.summaries[0].rows[0].verdict, Verdict::Unbiased);
    EXPECT_EQ(table.summaries[0].rows[1].verdict, Verdict::Biased);
    EXPECT_EQ(table.hypotheses, 2 * 69);
    const std::string text = biasTable(table);
    EXPECT_NE(text.find("| `wrong` | -20."), std::string::npos) << text;
    EXPECT_NE(text.find("biased |\n"), std::string::npos) << text;
    EXPECT_NE(detailTable(table).find("| `right` | static | 80 |"), std::string::npos);
    EXPECT_EQ(tabulate(file, 0.001).summaries[0].rows[0].verdict, Verdict::Open);
}

TEST_F(ProofFiles, TablesOfScenes) {
    ProofFile file(path("scenes.json"));
    makeReference(file);
    addPairs(file, "right", 0, 0, 40);
    for (const char* scene : {"builtin:some", "builtin:other"}) {
        file.references.push_back(file.references[0]);
        file.references.back().subject.scene = scene;
        file.cells.push_back(file.cells[0]);
        file.cells.back().subject.scene = scene;
    }
    EXPECT_EQ(tabulate(file, 0.02).summaries.size(), 3u);
    const Table table = tabulate(file, 0.02, Lines::Scenes);
    ASSERT_EQ(table.summaries.size(), 1u);
    EXPECT_TRUE(table.summaries[0].title.starts_with("right, ")) << table.summaries[0].title;
    ASSERT_EQ(table.summaries[0].rows.size(), 3u);
    EXPECT_EQ(table.summaries[0].rows[2].name, "builtin:other");
}

TEST_F(ProofFiles, BrokenOnesAreNamed) {
    std::ofstream(path("broken.json")) << "{\"format\": 1, \"references\": [";
    try {
        ProofFile file(path("broken.json"));
        FAIL();
    } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what()).find("broken.json: cannot be read"), std::string::npos)
            << error.what();
    }
}

TEST(Proof, Rows) {
    const Row row = parseRow("quick=radius=6 weights=off");
    EXPECT_EQ(row.name, "quick");
    EXPECT_EQ(row.settings, "weights=off visibility=traced radius=6");
    EXPECT_EQ(parseRow("plain=").settings, "weights=pairwise visibility=traced");
    EXPECT_THROW(parseRow("radius"), std::runtime_error);
    EXPECT_EQ(namedRows("weights").size(), 12u);
    EXPECT_EQ(namedRows("presets").size(), 4u);
    std::set<std::string> settings;
    for (const Row& option : namedRows("options")) EXPECT_TRUE(settings.insert(option.settings).second) << option.name;
    EXPECT_THROW(namedRows("nothing"), std::runtime_error);
    EXPECT_NE(Subject({.scene = "a", .scenario = "b", .row = "c"}).seed(0),
              Subject({.scene = "a", .scenario = "b", .row = "d"}).seed(0));
}

}   // namespace
}   // namespace tests
