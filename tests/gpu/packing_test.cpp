// Packed forms, held to the error bounds that shaders/restir/core/pack.glsl promises.
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "gpu/values.h"

namespace {

using tests::Record;
using tests::RecordOf;
using tests::Value;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

std::vector<Record> pack(const std::vector<glm::vec3>& values) {
    std::vector<Record> records;
    for (glm::vec3 value : values) records.push_back(RecordOf(Value::Packed).add(value));
    return tests::evaluate(records);
}

class Packing : public tests::GpuTest {};

double degreesBetween(glm::dvec3 a, glm::dvec3 b) {
    return glm::degrees(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)));
}

TEST_F(Packing, NormalsAreWithinTheirAngle) {
    std::vector<glm::vec3> normals;
    for (int x = -1; x <= 1; ++x)   // axes, folds, corners
        for (int y = -1; y <= 1; ++y)
            for (int z = -1; z <= 1; ++z)
                if (x || y || z) normals.push_back(glm::normalize(glm::vec3(x, y, z)));
    std::mt19937 random(1);
    std::normal_distribution<float> normal;
    for (int i = 0; i < 40'000; ++i) {
        glm::vec3 n(normal(random), normal(random), normal(random));
        if (i % 4 == 1) n.z *= 1e-4f;   // along the fold, and near the poles
        if (i % 4 == 2) n *= glm::vec3(1e-4f, 1e-4f, 1);
        normals.push_back(glm::normalize(n));
    }
    const std::vector<Record> results = pack(normals);
    double worst = 0;
    for (size_t i = 0; i < normals.size(); ++i) {
        const glm::dvec3 back = results[i].vector(0);
        EXPECT_NEAR(glm::length(back), 1, 1e-6);
        worst = std::max(worst, degreesBetween(back, normals[i]));
    }
    EXPECT_LT(worst, 0.004);
    EXPECT_GT(worst, 0.001) << "the bound is no longer the right one";
}

TEST_F(Packing, AxesAreExact) {
    const std::vector<glm::vec3> axes{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    const std::vector<Record> results = pack(axes);
    for (size_t i = 0; i < axes.size(); ++i) EXPECT_EQ(results[i].vector(0), axes[i]);
}

TEST_F(Packing, ColorsAreWithinTheirError) {
    std::vector<glm::vec3> colors;
    for (int i = 0; i <= 3000; ++i) {
        const float c = static_cast<float>(i) / 3000;
        colors.emplace_back(c, c * c * c, 1 - c);
    }
    const std::vector<Record> results = pack(colors);
    for (size_t i = 0; i < colors.size(); ++i) {
        for (int k = 0; k < 3; ++k) {
            const double wanted = double(colors[i][k]), got = double(results[i].vector(3)[k]);
            EXPECT_LE(std::abs(got - wanted), 0.5 / 1023 * (2 * std::sqrt(wanted) + 0.5 / 1023) + 1e-6)
                << wanted;
            const double promised = wanted >= 0.99 ? 0.001 : wanted >= 0.01 ? 0.01 : 1e9;
            EXPECT_LE(std::abs(got - wanted), promised * wanted) << wanted;
        }
    }
    const std::vector<Record> ends = pack({{0, 1, 0.25f}, {-1, 2, kNan}, {-kInfinity, kInfinity, 0.5f}});
    EXPECT_EQ(ends[0].vector(3).x, 0);
    EXPECT_EQ(ends[0].vector(3).y, 1);
    EXPECT_EQ(ends[1].vector(3), glm::vec3(0, 1, 0));
    EXPECT_EQ(ends[2].vector(3).x, 0);
    EXPECT_EQ(ends[2].vector(3).y, 1);
}

// Storing what was read changes nothing, or colours would drift from frame to frame.
TEST_F(Packing, PackingIsStable) {
    std::mt19937 random(2);
    std::uniform_real_distribution<float> unit(0, 1);
    std::vector<glm::vec3> values;
    for (int i = 0; i < 4000; ++i) values.emplace_back(unit(random), unit(random), unit(random));
    const std::vector<Record> once = pack(values);
    std::vector<glm::vec3> colors, uvs;
    for (const Record& r : once) {
        EXPECT_EQ(r.words[12], r.words[13]);
        colors.push_back(r.vector(3));
        uvs.push_back(r.vector(9));
    }
    const std::vector<Record> colorsAgain = pack(colors), uvsAgain = pack(uvs);
    for (size_t i = 0; i < values.size(); ++i) {
        EXPECT_EQ(colorsAgain[i].vector(3), colors[i]);
        EXPECT_EQ(uvsAgain[i].vector(9), uvs[i]);
        EXPECT_NEAR(uvs[i].x, values[i].x, 0.5 / 65535 + 1e-7);
        EXPECT_NEAR(uvs[i].y, values[i].y, 0.5 / 65535 + 1e-7);
    }
}

constexpr double kHalfStep = 0.5 / (1 << 24);   // of the smallest exponent

void expectRadiance(const std::vector<glm::vec3>& values) {
    const std::vector<Record> results = pack(values);
    for (size_t i = 0; i < values.size(); ++i) {
        const glm::dvec3 wanted = glm::min(glm::dvec3(values[i]), glm::dvec3(65408)),
                         got = results[i].vector(6);
        const double largest = std::max({wanted.x, wanted.y, wanted.z});
        for (int k = 0; k < 3; ++k)
            EXPECT_LE(std::abs(got[k] - wanted[k]), std::max(largest / 512, kHalfStep))
                << wanted[k] << " beside " << largest << " became " << got[k];
    }
}

TEST_F(Packing, RadianceIsWithinItsError) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> exponent(-26, 16), unit(0, 1);
    std::vector<glm::vec3> values;
    for (int i = 0; i < 20'000; ++i)
        values.push_back(std::exp2(exponent(random)) * glm::vec3(unit(random), unit(random), unit(random)));
    for (int e = -24; e <= 15; ++e)   // the mantissa's carry into the exponent, from both sides
        for (float near : {1.0f, 1.9960f, 1.9961f, 1.9980f, 1.9981f, 1.9999f})
            values.emplace_back(std::ldexp(near, e), 0.0f, std::ldexp(near, e) / 3);
    expectRadiance(values);
}

TEST_F(Packing, RadianceAtItsEnds) {
    const std::vector<Record> results = pack({{0, 0, 0},
                                              {1e-9f, 1e-42f, 0},
                                              {1e9f, 1, 0},
                                              {kInfinity, kInfinity, kInfinity},
                                              {kNan, 2, kNan},
                                              {-1, -kInfinity, 4},
                                              {65408, 65407, 32768}});
    const glm::vec3 expected[] = {{0, 0, 0}, {0, 0, 0}, {65408, 0, 0}, {65408, 65408, 65408},
                                  {0, 2, 0}, {0, 0, 4}};
    for (size_t i = 0; i < std::size(expected); ++i) EXPECT_EQ(results[i].vector(6), expected[i]) << i;
    EXPECT_EQ(results[0].words[12], 0u);
    EXPECT_EQ(results[6].vector(6), glm::vec3(65408, 65408, 32768));
}

Record lightRecord(glm::vec3 light, glm::vec3 u) { return RecordOf(Value::Light).add(light).add(u); }

// Whatever is packed, its mean over the random numbers is itself: here over a grid of them, finer than any
// mantissa.
TEST_F(Packing, RoundedAtRandomTheMeanIsRight) {
    constexpr int kSteps = 4096;
    for (const glm::vec3 value :
         {glm::vec3(1, 0.3f, 0.01f), glm::vec3(2.5f, 1e-4f, 7), glm::vec3(511, 511.5f, 512),
          glm::vec3(1e-9f, 3e-8f, 2e-7f), glm::vec3(65280, 65279, 1), glm::vec3(0, 0, 1e-3f)}) {
        std::vector<Record> records;
        for (int i = 0; i < kSteps; ++i)
            records.push_back(lightRecord(value, glm::vec3((float(i) + 0.5f) / kSteps)));
        glm::dvec3 mean(0), shares(0);
        for (const Record& result : tests::evaluate(records)) {
            mean += glm::dvec3(result.vector(0)) / double(kSteps);
            shares += glm::dvec3(result.vector(3)) / double(kSteps);
        }
        const double largest = std::max({value.x, value.y, value.z}),
                     step = std::max(largest / 256, std::ldexp(1.0, -24));
        for (int k = 0; k < 3; ++k) {
            EXPECT_NEAR(mean[k], double(value[k]), 2 * step / kSteps + 1e-7 * largest) << value[k];
            EXPECT_NEAR(shares[k], double(value[k]) / largest, 2.0 / 1023 / kSteps + 1e-7) << value[k];
        }
    }
}

TEST_F(Packing, RoundedAtRandomItsEndsStay) {
    constexpr float kAlmostOne = 0x1.fffffep-1f;
    const std::vector<Record> results = tests::evaluate(std::vector<Record>{
        lightRecord({0, 0, 0}, glm::vec3(0.999f)), lightRecord({kNan, 1, kNan}, {}),
        lightRecord({kInfinity, -kInfinity, 1e9f}, glm::vec3(0.5f)),
        lightRecord({511, 511, 1}, glm::vec3(kAlmostOne)), lightRecord({1, 1, 1}, glm::vec3(kAlmostOne))});
    EXPECT_EQ(results[0].words[6], 0u);
    EXPECT_EQ(results[1].vector(0), glm::vec3(0, 1, 0));
    EXPECT_EQ(results[2].vector(0), glm::vec3(65280, 0, 65280));
    EXPECT_EQ(results[3].vector(0), glm::vec3(512, 512, 2));
    EXPECT_EQ(results[3].vector(3), glm::vec3(1, 1, 3.0f / 1023));
    EXPECT_EQ(results[4].vector(3), glm::vec3(1));
}

}   // namespace
