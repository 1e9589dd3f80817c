// The table that LightTable builds on the device: it draws each light exactly as often as the light says,
// that is by its power, and its bits depend on the lights alone.
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <limits>
#include <numbers>
#include <numeric>
#include <random>

#include "gpu/built_table.h"
#include "support/gpu.h"
#include "support/statistics.h"

namespace {

using restir::Light;
using restir::LightKind;
using tests::BuiltTable;
using Weights = std::vector<double>;

constexpr double kPi = std::numbers::pi;

// Powers have 22 bits, what rounding leaves over goes to the heaviest light, a unit is 2^-42 of the heaviest.
constexpr double kPowerError = 1.0 / (1 << 22), kShareError = 3.0 / 4294967296.0;

class LightTables : public tests::GpuTest {};

// Of these powers; ids from the end.
std::vector<Light> points(const Weights& powers) {
    std::vector<Light> lights;
    for (size_t i = powers.size(); i-- > 0;) {
        Light light{.id = static_cast<uint32_t>(i), .kind = LightKind::Point};
        for (float& e : light.emission) e = static_cast<float>(powers[i] / (4 * kPi));
        lights.push_back(light);
    }
    return lights;
}

// How much of the columns' 2^32 each belongs to each light.
std::vector<uint64_t> shares(const BuiltTable& table) {
    constexpr uint64_t kColumn = uint64_t{1} << 32;
    std::vector<uint64_t> share(table.alias.size());
    for (size_t i = 0; i < share.size(); ++i) {
        const auto [threshold, alias] = table.alias[i];
        if (alias >= share.size()) {
            ADD_FAILURE() << "column " << i << " has alias " << alias;
            return share;
        }
        share[i] += threshold;
        share[alias] += kColumn - threshold;
    }
    return share;
}

void expectExact(const BuiltTable& table) {
    const std::vector<uint64_t> share = shares(table);
    double sum = 0;
    for (size_t i = 0; i < share.size(); ++i) {
        const double probability = double(share[i]) / 4294967296.0 / double(share.size());
        if (i >= table.lights.size()) {
            ASSERT_EQ(share[i], 0u) << "a column without a light: " << i;
            continue;
        }
        ASSERT_NEAR(double(table.lights[i].selection), probability, 1.2e-7 * probability) << "light " << i;
        ASSERT_EQ(table.lights[i].selection > 0, share[i] > 0) << "light " << i;
        sum += double(table.lights[i].selection);
    }
    EXPECT_NEAR(sum, 1, 1e-6);
}

void expectPowers(const BuiltTable& table, const Weights& powers) {
    expectExact(table);
    ASSERT_EQ(table.lights.size(), powers.size());
    const double total = std::accumulate(powers.begin(), powers.end(), 0.0);
    for (size_t i = 0; i < powers.size(); ++i) {
        const double wanted = powers[i] / total;
        ASSERT_NEAR(double(table.lights[i].selection), wanted, 2 * kPowerError * wanted + kShareError)
            << "light " << i;
        ASSERT_EQ(table.lights[i].selection > 0, powers[i] > 0) << "light " << i;
    }
}

Weights wild(size_t count, uint32_t seed, double exponent, uint32_t blackEvery) {
    std::mt19937_64 random(seed);
    std::exponential_distribution<double> heavy(1.0);
    Weights powers(count);
    for (size_t i = 0; i < count; ++i)
        powers[i] = blackEvery && i % blackEvery == 0 ? 0 : std::pow(heavy(random), exponent);
    return powers;
}

TEST_F(LightTables, FewLights) {
    for (const Weights& powers : {Weights{5},
                                  {1, 1},
                                  {1, 1, 1, 1},
                                  {1, 1, 1, 1, 1},
                                  {1, 2, 3, 4, 5},
                                  {3, 0},
                                  {0, 0, 1, 0, 2, 0},
                                  {0.1, 1e-3, 7, 1e4, 1e-7, 12},
                                  {0, 0, 0, 1e-30}})
        expectPowers(tests::build(points(powers)), powers);
}

// Blocks have 1024 columns; 2^20 columns are 1024 of them.
TEST_F(LightTables, AnyNumberOfLights) {
    for (size_t count : {3u, 63u, 255u, 256u, 257u, 1023u, 1024u, 1025u, 2048u, 2049u, 5000u, 65537u})
        expectPowers(tests::build(points(wild(count, uint32_t(count), 3, 7))),
                     wild(count, uint32_t(count), 3, 7));
}

// Every column is as full as the next: what rounding takes off goes around.
TEST_F(LightTables, EqualLights) {
    for (size_t count : {2u, 1000u, 1024u, 4097u, 30000u})
        expectPowers(tests::build(points(Weights(count, 0.7))), Weights(count, 0.7));
}

// The order of heavy and light ones decides who fills whom.
TEST_F(LightTables, HeavyOnesFirstLastAndBetween) {
    Weights rising(3000), single(3000, 1e-3);
    for (size_t i = 0; i < rising.size(); ++i) rising[i] = double(i);
    Weights falling(rising.rbegin(), rising.rend()), two = single;
    single.front() = 1e6;
    two.front() = two.back() = 1e6;
    Weights last(single.rbegin(), single.rend()), middle = Weights(3000, 1e-3);
    middle[1500] = 1e6;
    for (const Weights& powers : {rising, falling, single, two, last, middle})
        expectPowers(tests::build(points(powers)), powers);
}

TEST_F(LightTables, TinyBesideHuge) {
    const auto check = [](const Weights& powers) {
        const BuiltTable table = tests::build(points(powers));
        expectExact(table);
        for (size_t i = 0; i < powers.size(); ++i)
            EXPECT_EQ(table.lights[i].selection > 0, powers[i] > 0) << "light " << i;
        return table;
    };
    EXPECT_NEAR(double(check({1e-20, 1e20, 1e-20, 0}).lights[1].selection), 1, 1e-9);
    check({1e20, 1e-20, 2e-37, 1e31, 2e-37});
    Weights many(5000, 1e-20);
    many[77] = 1e20;
    many[3000] = 0;
    EXPECT_NEAR(double(check(many).lights[77].selection), 1, 1e-6);
    for (size_t i = 0; i < many.size(); ++i) many[i] = i % 2 ? 1e-25 : 1e25;   // each of many heaviest
    EXPECT_NEAR(double(check(many).lights[0].selection), 1 / 2500.0, 1e-9);
}

// Products of the fields leave the range of floats, their powers do not.
TEST_F(LightTables, TinyAndHugeTriangles) {
    const auto triangle = [](uint32_t id, float size, float emission) {
        Light light{.id = id, .vertex1 = {size, 0, 0}, .vertex2 = {0, size, 0}};
        for (float& e : light.emission) e = emission;
        return light;
    };
    const BuiltTable table = tests::build(
        std::vector{triangle(0, 1e9f, 1e30f), triangle(1, 2e-15f, 1e-30f), triangle(2, 1e9f, 1e30f)});
    expectExact(table);
    EXPECT_NEAR(double(table.lights[0].selection), 0.5, 1e-6);
    EXPECT_GT(table.lights[1].selection, 0);
    const BuiltTable tiny =
        tests::build(std::vector{triangle(0, 2e-15f, 1e-30f), triangle(1, 1e-15f, 4e-30f)});
    EXPECT_NEAR(double(tiny.lights[0].selection), 0.5, 1e-6);
}

TEST_F(LightTables, DarkOnesAreNeverDrawn) {
    for (size_t count : {1u, 2u, 3u, 1500u}) {
        const BuiltTable table = tests::build(points(Weights(count)));
        for (size_t i = 0; i < table.alias.size(); ++i) EXPECT_EQ(table.alias[i].alias, i);
        for (const auto& light : table.lights) EXPECT_EQ(light.selection, 0);
    }
    EXPECT_TRUE(tests::build({}).alias.empty());
}

TEST_F(LightTables, GapsInTheIds) {
    std::vector<Light> lights = points({1, 2, 3});
    for (Light& light : lights) light.id = light.id * 700 + 5;
    const BuiltTable table = tests::build(lights, 20000);
    expectExact(table);
    ASSERT_EQ(table.lights.size(), 1406u);
    for (size_t id = 0; id < table.lights.size(); ++id) {
        const bool used = id % 700 == 5;
        EXPECT_EQ((table.lights[id].kindAndTexture & RS_LIGHT_KIND_MASK) != RS_LIGHT_NONE, used);
        EXPECT_NEAR(double(table.lights[id].selection), used ? double(id / 700 + 1) / 6 : 0, 1e-6);
    }
}

// Of a smaller and of a larger set, one after the other, in either generation of buffers.
TEST_F(LightTables, NothingOfTheLastBuildStays) {
    const Weights powers = wild(3000, 5, 2, 5);
    for (uint32_t times : {2u, 3u}) expectPowers(tests::build(points(powers), 9000, times), powers);
}

TEST_F(LightTables, SameLightsSameBits) {
    const std::vector<Light> lights = points(wild(40000, 3, 6, 11));
    const BuiltTable first = tests::build(lights);
    std::vector<Light> reordered(lights.rbegin(), lights.rend());
    for (uint32_t i = 0; i < 3; ++i) {
        const BuiltTable again = tests::build(i == 0 ? reordered : lights);
        ASSERT_EQ(
            std::memcmp(first.alias.data(), again.alias.data(), first.alias.size() * sizeof first.alias[0]),
            0);
        ASSERT_EQ(std::memcmp(first.lights.data(), again.lights.data(),
                              first.lights.size() * sizeof first.lights[0]),
                  0);
    }
}

// Radiant power by luminance.
TEST_F(LightTables, SelectionFollowsRadiantPower) {
    const auto triangle = [](uint32_t id, float size) {
        return Light{
            .id = id, .position = {1, 2, 3}, .vertex1 = {1 + size, 2, 3}, .vertex2 = {1, 2 + size, 3}};
    };
    Light twoSided = triangle(1, 1), textured = triangle(2, 1), coloured = triangle(7, 1);
    twoSided.twoSided = true;
    textured.texture = 4;
    textured.meanLuminance = 3;
    const float green[] = {0, 4, 0};
    std::copy(green, green + 3, coloured.emission);
    Light spot{.id = 5, .kind = LightKind::Spot, .innerCone = 0.3f, .outerCone = 0.9f};
    Light sun{.id = 6, .kind = LightKind::Directional};
    const Light bulb{.id = 4, .kind = LightKind::Point, .position = {0, 20, 3}};
    const BuiltTable table = tests::build(
        std::vector{triangle(0, 1), twoSided, textured, triangle(3, 2), bulb, spot, sun, coloured});
    expectExact(table);
    const double one = double(table.lights[0].selection) / (0.5 * kPi);
    const auto power = [&](uint32_t id) { return double(table.lights[id].selection) / one; };
    EXPECT_NEAR(power(1), kPi, 1e-5);
    EXPECT_NEAR(power(2), 1.5 * kPi, 1e-5);
    EXPECT_NEAR(power(3), 2 * kPi, 1e-5);
    EXPECT_NEAR(power(4), 4 * kPi, 1e-5);
    // The cone's square rises from 0 to 1 evenly with the cosine.
    const double inner = std::cos(0.3), outer = std::cos(0.9);
    EXPECT_NEAR(power(5), 2 * kPi * ((1 - inner) + (inner - outer) / 3), 1e-5);
    // From (0, 0, 0), the spot, to (1, 20, 3).
    EXPECT_NEAR(power(6), kPi * 0.25 * (1 + 400 + 9), 1e-3);
    EXPECT_NEAR(power(7), 0.5 * kPi * 4 * 0.7152, 1e-5);
}

TEST_F(LightTables, SelectionOfRoundAndFlatOnes) {
    const Light bulb{.id = 0, .kind = LightKind::Point};   // 4 pi
    Light sphere{.id = 1, .kind = LightKind::Sphere, .radius = 0.5f};
    Light tube{.id = 2, .kind = LightKind::Capsule, .twoSided = true, .vertex1 = {0, 3, 0}, .radius = 0.5f};
    Light disk{.id = 3, .kind = LightKind::Disk, .direction = {1, 2, 3}, .radius = 0.5f};
    Light flat{.id = 4, .kind = LightKind::Rectangle, .twoSided = true, .vertex1 = {2, 0, 0}, .vertex2 = {1, 3, 0}};
    const BuiltTable table = tests::build(std::vector{bulb, sphere, tube, disk, flat});
    expectExact(table);
    const auto power = [&](uint32_t id) { return 4 * kPi * double(table.lights[id].selection) / double(table.lights[0].selection); };
    EXPECT_NEAR(power(1), kPi * kPi, 1e-4);
    EXPECT_NEAR(power(2), 4 * kPi * kPi, 1e-4);   // one-sided all the same
    EXPECT_NEAR(power(3), kPi * kPi / 4, 1e-4);
    EXPECT_NEAR(power(4), 12 * kPi, 1e-4);
    // Hair, dust and what has no size.
    sphere.radius = 1e-15f;
    tube.radius = 1e-12f;
    tube.vertex1[1] = 1e9f;
    disk.radius = 0;
    for (int i = 0; i < 3; ++i) flat.vertex2[i] = flat.position[i];
    const BuiltTable thin = tests::build(std::vector{sphere, tube, disk, flat});
    EXPECT_GT(thin.lights[1].selection, 0);
    EXPECT_NEAR(double(thin.lights[2].selection), 1, 1e-6);
    EXPECT_EQ(thin.lights[3].selection, 0);
    EXPECT_EQ(thin.lights[4].selection, 0);
}

// A directional light shines on the disc of radius 1, where nothing else says how much there is to shine on.
TEST_F(LightTables, DirectionalLightsAlone) {
    Light sun{.id = 0, .kind = LightKind::Directional}, moon{.id = 1, .kind = LightKind::Directional};
    for (float& e : moon.emission) e = 3;
    EXPECT_NEAR(double(tests::build(std::vector{sun, moon}).lights[1].selection), 0.75, 1e-6);
    const Light bulb{.id = 2, .kind = LightKind::Point, .position = {50, -3, 2}};
    const BuiltTable table = tests::build(std::vector{sun, moon, bulb});
    EXPECT_NEAR(double(table.lights[2].selection), 4.0 / (4 + 3 + 1), 1e-6);
    const Light far{.id = 3, .kind = LightKind::Point, .position = {-3e38f, 0, 0}};
    EXPECT_GT(tests::build(std::vector{sun, bulb, far}).lights[3].selection, 0);
}

// The driver reads its number of threads and the width of its vectors once, so each build is a process of its
// own.
TEST_F(LightTables, DISABLED_PrintsItsBits) {
    const BuiltTable table = tests::build(points(wild(20000, 9, 6, 11)));
    std::ofstream file(std::getenv("RESTIR_TABLE_BITS"), std::ios::binary);
    file.write(reinterpret_cast<const char*>(table.alias.data()),
               std::streamsize(table.alias.size() * sizeof table.alias[0]));
    file.write(reinterpret_cast<const char*>(table.lights.data()),
               std::streamsize(table.lights.size() * sizeof table.lights[0]));
}

std::string bitsIn(const std::string& environment) {
    const std::string file = testing::TempDir() + "restir_table_" + std::to_string(std::random_device{}());
    const std::string command =
        environment + " GTEST_TOTAL_SHARDS=1 GTEST_SHARD_INDEX=0 RESTIR_TABLE_BITS='" + file + "' '" + testing::internal::GetArgvs()[0] +
        "' --gtest_also_run_disabled_tests --gtest_filter=LightTables.DISABLED_PrintsItsBits "
        "--gtest_brief=1 > /dev/null";
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
    std::ifstream stream(file, std::ios::binary);
    std::string bits{std::istreambuf_iterator<char>(stream), {}};
    std::remove(file.c_str());
    EXPECT_GT(bits.size(), 1000000u);
    return bits;
}

TEST_F(LightTables, SameBitsOnAnyNumberOfThreads) {
    const std::string one = bitsIn("LP_NUM_THREADS=1");
    EXPECT_EQ(one, bitsIn("LP_NUM_THREADS=2"));
    // Mesa's cache does not tell vectors of 128 bits, subgroups of 4, from those of 256.
    EXPECT_EQ(one, bitsIn("MESA_SHADER_CACHE_DISABLE=true LP_NATIVE_VECTOR_WIDTH=128"));
}

}   // namespace
