// Reuse, against exact expectations (THEORY.md, sections 3 to 5, 9): the unbiased combinations are, the
// biased ones are not, and planted bugs show.
#include <cmath>
#include <ostream>

#include <restir/shared/di.h>

#include "combine.spv.h"
#include "gpu/built_table.h"
#include "support/closed_form.h"
#include "support/gpu.h"
#include "support/statistics.h"

namespace {

using restir::Light;
using restir::LightKind;
using namespace restir::gpu;

constexpr uint32_t kSamples = 1u << 18;
constexpr uint32_t kSurfaces = 6, kLights = 6;
constexpr uint32_t kDropEmpty = 1, kCurrentLights = 2;   // planted bugs of combine.glsl
constexpr uint32_t kAll = 0xff;
constexpr uint32_t kUnbiasedWeights[] = {RS_WEIGHTS_BASIC, RS_WEIGHTS_BALANCE, RS_WEIGHTS_PAIRWISE,
                                         RS_WEIGHTS_PAIRWISE_PLAIN};

struct TestSurface {   // as in combine.glsl
    glm::vec3 position{0}, normal{0, 0, 1}, baseColor{0.8f, 0.6f, 0.4f};
    uint32_t visible = kAll, confidence = 1;
};
struct Parameters {
    RsDiConstants di{};
    uint32_t seed = 0, neighbours = 0, previous = 0, planted = 0, lightCount = 0, nextEvent = 0, averaged = 0;
    TestSurface surfaces[kSurfaces];
    glm::vec3 centres[8] = {};
};

// A frame to reuse in: surface 0 is the pixel's own.
struct Setting {
    std::vector<TestSurface> surfaces;
    std::vector<Light> lights, previousLights;   // the latter only where neighbours are the last frame's
};

Light triangle(uint32_t id, glm::vec3 centre, glm::vec3 emission) {
    const glm::vec3 n = glm::normalize(-centre),
                    side = glm::normalize(glm::cross(n, glm::vec3(0.3f, 1, 0.2f)));
    const glm::vec3 up = glm::cross(n, side);
    const glm::vec3 corners[] = {centre - 0.3f * side - 0.2f * up, centre + 0.3f * side - 0.2f * up,
                                 centre + 0.35f * up};
    Light light{.id = id};
    for (int k = 0; k < 3; ++k) {
        light.position[k] = corners[0][k];
        light.vertex1[k] = corners[1][k];
        light.vertex2[k] = corners[2][k];
        light.emission[k] = emission[k];
    }
    return light;
}
Light point(uint32_t id, glm::vec3 position, glm::vec3 intensity) {
    return {.id = id,
            .kind = LightKind::Point,
            .position = {position.x, position.y, position.z},
            .emission = {intensity.x, intensity.y, intensity.z}};
}

const glm::vec3 kCentres[kLights] = {{-2, 0, 1.5f},   {2, 0, 1.5f}, {0, 2, 1},
                                     {0.2f, 0.3f, 3}, {9, 9, 9},    {0, -2, 0.8f}};

// Id 4 names nothing.
std::vector<Light> sixLights() {
    return {triangle(0, kCentres[0], {30, 25, 20}), triangle(1, kCentres[1], {4, 9, 16}),
            point(2, kCentres[2], {2, 2, 1}), triangle(3, kCentres[3], {5, 5, 9}),
            point(5, kCentres[5], {3, 1, 0.5f})};
}

// Normals so different that neighbours cannot have what the canonical sees; one sees nothing at all.
Setting tilted() {
    return {{{{0, 0, 0}, {0, 0, 1}},
             {{0.05f, 0, 0}, glm::normalize(glm::vec3(1, 0, 0.3f))},
             {{-0.05f, 0.02f, 0}, glm::normalize(glm::vec3(-1, 0, 0.3f)), {0.2f, 0.9f, 0.5f}, kAll, 4},
             {{0, 0.06f, 0}, {0, 0, -1}, {0.5f, 0.5f, 0.5f}, kAll, 3},
             {{0, -0.06f, 0.01f}, glm::normalize(glm::vec3(0, 1, 0.3f)), {0.1f, 0.1f, 0.9f}, kAll, 2}},
            sixLights(),
            {}};
}

// One plane, but everyone in another shadow.
Setting shadowed() {
    return {{{{0, 0, 0}, {0, 0, 1}, {0.8f, 0.6f, 0.4f}, 0b001111},
             {{0.05f, 0, 0}, {0, 0, 1}, {0.8f, 0.6f, 0.4f}, 0b100110, 2},
             {{-0.05f, 0.02f, 0}, {0, 0, 1}, {0.2f, 0.9f, 0.5f}, 0b100001},
             {{0, 0.06f, 0}, {0, 0, 1}, {0.5f, 0.5f, 0.5f}, 0, 3},
             {{0, -0.06f, 0.01f}, {0, 0, 1}, {0.1f, 0.1f, 0.9f}, 0b101000}},
            sixLights(),
            {}};
}

// Last frame light 0 stood elsewhere and was larger, 1 was off, 2 brighter, and 5 has gone since.
Setting moving() {
    Setting s{{{{0, 0, 0}, {0, 0, 1}},
               {{0.03f, -0.02f, 0}, glm::normalize(glm::vec3(0.2f, 0.1f, 1)), {0.7f, 0.7f, 0.5f}, kAll, 3}},
              sixLights(),
              {}};
    s.previousLights = {triangle(0, {-1.7f, 0.3f, 1.3f}, {30, 25, 20}), point(2, kCentres[2], {6, 6, 3}),
                        triangle(3, kCentres[3], {5, 5, 9}), point(5, kCentres[5], {3, 1, 0.5f})};
    for (int k = 0; k < 3; ++k) s.previousLights[0].vertex1[k] += 0.3f * (k == 1 ? 1.0f : 0.2f);
    s.lights.pop_back();
    return s;
}

// Likewise, but light 1 only grew brighter; and there are more pixels of the last frame, each in its own shadow.
Setting crowded() {
    Setting s = moving();
    s.previousLights.insert(s.previousLights.begin(), triangle(1, kCentres[1], {3, 6, 12}));
    const glm::vec3 tilted = glm::normalize(glm::vec3(0.6f, -0.2f, 1));
    s.surfaces.push_back({{0.08f, 0.03f, 0}, {0, 0, 1}, {0.3f, 0.6f, 0.9f}, 0b101101});
    s.surfaces.push_back({{-0.07f, 0.05f, 0}, tilted, {0.9f, 0.5f, 0.1f}, 0b011110, 2});
    s.surfaces.push_back({{0.01f, -0.09f, 0}, {0, 0, 1}, {0.8f, 0.6f, 0.4f}, 0, 2});
    return s;
}

struct Mode {
    uint32_t weights = RS_WEIGHTS_PAIRWISE, visibility = RS_VISIBILITY_NONE;
    uint32_t bsdfCandidates = 0, planted = 0, nextEvent = 0;
    bool averaged = false;   // shade the mean of all inputs
    uint32_t initialSamples = 1, lightCandidates = 4;

    friend std::ostream& operator<<(std::ostream& out, const Mode& m) {
        const char* weightNames[] = {"off", "basic", "balance", "pairwise", "plain"};
        const char* visibilityNames[] = {"none", "cached", "traced"};
        return out << weightNames[m.weights] << ", " << visibilityNames[m.visibility] << ", "
                   << m.initialSamples << " rounds, " << m.bsdfCandidates << " directions"
                   << (m.averaged ? ", averaged" : "");
    }
};

// One more id past the last light, so that both frames have as many columns.
tests::BuiltTable build(std::vector<Light> lights) {
    Light black = point(kLights - 1, {0, 0, -50}, {0, 0, 0});
    if (lights.back().id != black.id) lights.push_back(black);
    return tests::build(lights);
}

struct Estimates {
    std::vector<double> channels[3];
    std::vector<double> confidences;
};

Estimates run(const Setting& setting, const Mode& mode, uint32_t seed) {
    Parameters p;
    p.di = {.lightCandidates = mode.lightCandidates,
            .bsdfCandidates = mode.bsdfCandidates,
            .weights = mode.weights,
            .visibility = mode.visibility,
            .initialSamples = mode.initialSamples,
            .freshConfidence = 1};
    p.seed = seed;
    p.neighbours = static_cast<uint32_t>(setting.surfaces.size()) - 1;
    p.previous = setting.previousLights.empty() ? 0 : 1;
    p.planted = mode.planted;
    p.nextEvent = mode.nextEvent;
    p.averaged = mode.averaged ? 1 : 0;
    p.lightCount = kLights;
    for (size_t i = 0; i < kSurfaces; ++i) p.surfaces[i].position = {0, 0, -100};
    for (size_t i = 0; i < setting.surfaces.size(); ++i) p.surfaces[i] = setting.surfaces[i];
    for (size_t i = 0; i < kLights; ++i) p.centres[i] = kCentres[i];
    const tests::BuiltTable now = build(setting.lights);
    const tests::BuiltTable before = p.previous ? build(setting.previousLights) : now;
    static const tests::Kernel kernel(k_combine_spv, 6);
    std::vector<glm::vec4> results(kSamples);
    kernel.run(kSamples / 64,
               {tests::in(std::vector<Parameters>{p}), tests::in(now.lights), tests::in(before.lights),
                tests::in(now.alias), tests::in(before.alias), tests::out(results)});
    Estimates estimates;
    for (const glm::vec4& r : results) {
        for (int k = 0; k < 3; ++k) estimates.channels[k].push_back(double(r[k]));
        estimates.confidences.push_back(double(r.w));
    }
    return estimates;
}

glm::dvec3 exact(const Setting& setting) {
    const TestSurface& s = setting.surfaces[0];
    glm::dvec3 sum(0);
    for (const Light& light : setting.lights)
        if (s.visible >> light.id & 1u) sum += tests::lightIrradiance(light, s.position, s.normal);
    return sum * glm::dvec3(s.baseColor) / 3.14159265358979;
}

// Independent samples: 4.5 standard errors over a few hundred comparisons is a false alarm in 10^3 runs, and
// the seeds are fixed.
void expectUnbiased(const Setting& setting, const Mode& mode) {
    SCOPED_TRACE(mode);
    const Estimates estimates = run(setting, mode, 100 + mode.weights * 10 + mode.visibility);
    const glm::dvec3 expected = exact(setting);
    for (int k = 0; k < 3; ++k) {
        const tests::Mean mean = tests::meanOf(estimates.channels[k]);
        EXPECT_LT(mean.relativeError(), 0.003) << "channel " << k;
        EXPECT_LT(std::abs(mean.z(expected[k])), 4.5)
            << "channel " << k << " is " << 100 * (mean.mean / expected[k] - 1) << " % off";
    }
}

// In every channel: the sign, at least `least` of it, and more than ten standard errors.
void expectBiased(const Setting& setting, const Mode& mode, double least, double most) {
    SCOPED_TRACE(mode);
    const Estimates estimates = run(setting, mode, 7);
    const glm::dvec3 expected = exact(setting);
    for (int k = 0; k < 3; ++k) {
        const tests::Mean mean = tests::meanOf(estimates.channels[k]);
        const double bias = mean.mean / expected[k] - 1;
        EXPECT_GT(std::abs(mean.z(expected[k])), 10) << "channel " << k;
        EXPECT_GT(bias, least) << "channel " << k;
        EXPECT_LT(bias, most) << "channel " << k;
    }
}

class Combine : public tests::GpuTest {};

TEST_F(Combine, UnbiasedOverDifferentSurfaces) {
    for (uint32_t weights : kUnbiasedWeights)
        for (uint32_t visibility : {RS_VISIBILITY_NONE, RS_VISIBILITY_TRACED})
            expectUnbiased(tilted(), {weights, visibility});
}

TEST_F(Combine, UnbiasedOverDifferentShadows) {
    for (uint32_t weights : kUnbiasedWeights)
        for (uint32_t visibility : {RS_VISIBILITY_NONE, RS_VISIBILITY_TRACED})
            for (uint32_t directions : {0u, 1u})
                expectUnbiased(shadowed(), {weights, visibility, directions});
}

TEST_F(Combine, UnbiasedOverFramesWhoseLightsChange) {
    for (uint32_t weights : kUnbiasedWeights)
        for (uint32_t visibility : {RS_VISIBILITY_NONE, RS_VISIBILITY_TRACED})
            for (uint32_t directions : {0u, 2u}) {
                expectUnbiased(moving(), {weights, visibility, directions});
                expectUnbiased(crowded(), {weights, visibility, directions});
            }
}

// Candidates alone, by lights and by directions, with and without killing.
TEST_F(Combine, FreshCandidatesAreUnbiased) {
    Setting alone = shadowed();
    alone.surfaces.resize(1);
    for (uint32_t visibility : {RS_VISIBILITY_NONE, RS_VISIBILITY_CACHED, RS_VISIBILITY_TRACED})
        for (uint32_t directions : {0u, 1u, 3u})
            expectUnbiased(alone, {RS_WEIGHTS_PAIRWISE, visibility, directions});
}

// Every round has a chance of its own to find a light in view.
TEST_F(Combine, RoundsAreUnbiasedAndQuieter) {
    Setting alone = shadowed();
    alone.surfaces.resize(1);
    for (uint32_t visibility : {RS_VISIBILITY_NONE, RS_VISIBILITY_CACHED, RS_VISIBILITY_TRACED})
        for (uint32_t directions : {0u, 1u, 3u})
            expectUnbiased(alone,
                           {.visibility = visibility, .bsdfCandidates = directions, .initialSamples = 3});
    for (uint32_t visibility : {RS_VISIBILITY_NONE, RS_VISIBILITY_TRACED})
        for (uint32_t directions : {0u, 1u})
            expectUnbiased(shadowed(),
                           {.visibility = visibility, .bsdfCandidates = directions, .initialSamples = 2});

    const Mode once{.visibility = RS_VISIBILITY_TRACED, .bsdfCandidates = 1, .lightCandidates = 8};
    const Mode often{
        .visibility = RS_VISIBILITY_TRACED, .bsdfCandidates = 1, .initialSamples = 4, .lightCandidates = 2};
    for (int k = 0; k < 3; ++k)
        EXPECT_LT(tests::meanOf(run(alone, often, 5).channels[k]).relativeError(),
                  tests::meanOf(run(alone, once, 5).channels[k]).relativeError());
}

// The mean of all inputs has the same expectation as the one that is kept, and less noise.
TEST_F(Combine, AveragedShadingIsUnbiasedAndQuieter) {
    for (const Setting& setting : {tilted(), shadowed(), moving(), crowded()}) {
        const Mode averaged{.visibility = RS_VISIBILITY_TRACED, .bsdfCandidates = 1, .averaged = true};
        expectUnbiased(setting, averaged);
        expectUnbiased(setting, {RS_WEIGHTS_PAIRWISE_PLAIN, RS_VISIBILITY_TRACED, 1, 0, 0, true});
        const Mode selected{.visibility = RS_VISIBILITY_TRACED, .bsdfCandidates = 1};
        for (int k = 0; k < 3; ++k)
            EXPECT_LT(tests::meanOf(run(setting, averaged, 5).channels[k]).relativeError(),
                      tests::meanOf(run(setting, selected, 5).channels[k]).relativeError());
    }
    const Mode off{.weights = RS_WEIGHTS_OFF, .visibility = RS_VISIBILITY_TRACED, .averaged = true};
    expectBiased(shadowed(), off, -0.9, -0.05);
}

TEST_F(Combine, NextEventIsUnbiased) { expectUnbiased(shadowed(), {.nextEvent = 1}); }

TEST_F(Combine, OffIsDarkWhereSupportsDiffer) {
    expectBiased(tilted(), {RS_WEIGHTS_OFF, RS_VISIBILITY_NONE}, -0.9, -0.05);
    expectBiased(shadowed(), {RS_WEIGHTS_OFF, RS_VISIBILITY_TRACED}, -0.9, -0.05);
}

TEST_F(Combine, CachedVisibilityIsDark) {
    for (uint32_t weights : kUnbiasedWeights)
        expectBiased(shadowed(), {weights, RS_VISIBILITY_CACHED}, -0.9, -0.05);
}

// Neither is biased where it need not be: everyone sees everything, from the same plane.
TEST_F(Combine, ShortcutsAreExactWhereAllAreAlike) {
    Setting alike = shadowed();
    for (TestSurface& s : alike.surfaces) s.visible = kAll;
    expectUnbiased(alike, {RS_WEIGHTS_OFF, RS_VISIBILITY_NONE});
    expectUnbiased(alike, {RS_WEIGHTS_PAIRWISE, RS_VISIBILITY_CACHED, 1});
}

TEST_F(Combine, PlantedBugsShow) {
    expectBiased(shadowed(), {RS_WEIGHTS_PAIRWISE, RS_VISIBILITY_TRACED, 0, kDropEmpty}, 0.003, 1);
    expectBiased(shadowed(), {RS_WEIGHTS_BALANCE, RS_VISIBILITY_TRACED, 0, kDropEmpty}, 0.003, 1);
    expectBiased(moving(), {RS_WEIGHTS_PAIRWISE, RS_VISIBILITY_NONE, 0, kCurrentLights}, -0.9, -0.03);
}

// Confidences add up, whatever became of the samples, and no weight was ever bad.
TEST_F(Combine, ConfidencesAddUp) {
    for (uint32_t weights = RS_WEIGHTS_OFF; weights <= RS_WEIGHTS_PAIRWISE_PLAIN; ++weights)
        for (double confidence : run(shadowed(), {weights, RS_VISIBILITY_TRACED}, 3).confidences)
            ASSERT_EQ(confidence, 1 + 2 + 1 + 3 + 1) << "weights " << weights;
}

}   // namespace
