// Indirect light against the reference path tracer, which shares no code with it.
#include <array>
#include <functional>

#include <gtest/gtest.h>

#include "image/host_view.h"
#include "image/hypothesis.h"
#include "image/stage.h"
#include "image/world.h"

namespace tests {
namespace {

using namespace samples::build;

constexpr VkExtent2D kExtent{32, 32};
constexpr uint32_t kPictures = 20, kFrames = 6, kBounces = 3;

restir::Settings indirect() {
    restir::Settings settings = unbiased();
    settings.gi.mode = restir::IndirectMode::Restir;
    settings.gi.bounces = kBounces;
    settings.gi.radius = 8;   // short and near: more independent samples in a picture
    settings.gi.maxHistory = 4;
    return settings;
}

NamedSettings named(const std::string& name, const std::function<void(restir::GiSettings&)>& change) {
    restir::Settings settings = indirect();
    change(settings.gi);
    return {name, settings};
}

const NamedSettings kPath = named("path", [](auto& gi) { gi.mode = restir::IndirectMode::Path; });
const NamedSettings kBoth = named("both", [](auto&) {});
const NamedSettings kPaired = named("paired", [](auto& gi) { gi.pairedNeighbours = true; });

std::vector<NamedSettings> allReuse() {
    return {kPath,
            kBoth,
            named("candidates", [](auto& gi) { gi.temporal = false, gi.spatialPasses = 0; }),
            named("temporal", [](auto& gi) { gi.spatialPasses = 0; }),
            named("spatial", [](auto& gi) { gi.temporal = false; }),
            kPaired,
            named("selected", [](auto& gi) { gi.averageShading = false; }),
            named("balance", [](auto& gi) { gi.temporal = false, gi.weights = restir::Weights::Balance; })};
}

void expectAgreement(World& world, const ReferenceBlocks& truth, const std::vector<NamedSettings>& all,
                     uint32_t pictures = kPictures, uint32_t frames = kFrames) {
    Verdict verdict(all.size(), pictures);
    for (const NamedSettings& each : all) {
        samples::Sequence sequence{.view = world.view(), .frames = frames, .accumulate = true};
        SeedStatistics statistics;
        for (sequence.seed = 1000; sequence.seed < 1000 + pictures; ++sequence.seed) {
            statistics.add(world.render(sequence, each.settings));
            EXPECT_EQ(world.renderer().stats().counters.rejectedWeights, 0u);
        }
        verdict.add("gi " + each.name, compare(statistics, truth));
    }
    verdict.expectUnitVariance();
}

void expectReference(samples::SceneData scene, const std::vector<NamedSettings>& all,
                     uint32_t pictures = kPictures) {
    World world(std::move(scene), kExtent);
    const samples::Sequence sequence{.view = world.view(), .frames = 4, .accumulate = true};
    expectAgreement(
        world, referenceFromSeeds(world.referenceSeeds(32, sequence, {.paths = 20, .bounces = kBounces})),
        all, pictures);
}

// Walls seen from inside.
void addRoom(samples::SceneData& scene, const Surface& surface, glm::vec3 low, glm::vec3 high) {
    samples::Geometry walls{.material = addMaterial(scene, surface)};
    addBox(walls, low, high);
    for (size_t i = 0; i < walls.indices.size(); i += 3) std::swap(walls.indices[i], walls.indices[i + 1]);
    for (glm::vec3& normal : walls.normals) normal = -normal;
    addInstance(scene, addMesh(scene, {walls}));
}

// A closed room with one lamp and two boxes: what the lamp does not see is lit by the walls alone.
samples::SceneData room(const Surface& boxes) {
    samples::SceneData scene;
    addRoom(scene, {.color = kAlbedo, .roughness = 1, .specular = 0}, {-2, 0, -2}, {2, 3, 2});
    samples::Geometry things{.material = addMaterial(scene, boxes)};
    addBox(things, glm::vec3(-1.2f, 0, -1), glm::vec3(-0.4f, 1.2f, -0.2f));
    addBox(things, glm::vec3(0.3f, 0, -0.4f), glm::vec3(1.1f, 0.6f, 0.4f));
    addInstance(scene, addMesh(scene, {things}));
    addQuad(scene, lamp({0, 2.5f, 0.3f}, 0.5f), {.color = {0, 0, 0}, .emission = {6, 5, 4}, .specular = 0});
    scene.views.push_back({.eye = {0, 1.3f, 1.95f}, .target = {0, 0.8f, 0}, .verticalFov = 0.9f});
    return scene;
}

TEST(Gi, DiffuseRoomAgreesWithTheReference) {
    expectReference(room({.color = kAlbedo, .roughness = 1, .specular = 0}), allReuse());
}

// What the boxes reflect changes with the view, and is as noisy.
TEST(Gi, GlossyRoomAgreesWithTheReference) {
    expectReference(room({.color = kAlbedo, .roughness = 77.0f / 255.0f, .metalness = 51.0f / 255.0f}),
                    {kPath, kBoth, kPaired}, 64);
}

// Where the pixel's own path has a share.
TEST(Gi, SmoothMetalAgreesWithTheReference) {
    expectReference(room({.color = kAlbedo, .roughness = 51.0f / 255.0f, .metalness = 1}),
                    {kBoth, kPaired}, 96);
}

// The floor of a room one wall of which shines. What direct light would be if it were blurred as well is the same to a
// fraction of a thousandth.
TEST(Gi, PartOfThePixelsBlursByAPixelAndNoMore) {
    samples::SceneData scene;
    addRoom(scene, {.color = kAlbedo, .roughness = 1, .specular = 0}, {-2, 0, -2}, {2, 3, 2});
    addQuad(scene, {.origin = {-1.99f, 0.1f, -1.9f}, .u = {0, 2.8f, 0}, .v = {0, 0, 3.8f}},
            {.color = {0, 0, 0}, .emission = {6, 5, 4}, .specular = 0});
    scene.views.push_back({.eye = {0, 1.3f, 1.2f}, .target = {0, 0, 0.2f}, .verticalFov = 0.9f});
    World world(std::move(scene), kExtent);
    samples::Sequence sequence{.view = world.view(), .frames = 4, .accumulate = true};
    SeedStatistics halves, blocks;
    for (sequence.seed = 1; sequence.seed <= 32; ++sequence.seed) {
        const samples::FloatImage reference = world.reference(sequence, {.paths = 20, .bounces = kBounces});
        halves.add(halfBlurred(reference));
        blocks.add(blockBlurred(reference));
    }
    expectAgreement(world, referenceFromSeeds(halves),
                    {named("checkerboard", [](auto& gi) { gi.checkerboard = true; }),
                     named("checkerboard, paired", [](auto& gi) { gi.checkerboard = gi.pairedNeighbours = true; })},
                    64);
    expectAgreement(world, referenceFromSeeds(blocks),
                    {named("half resolution", [](auto& gi) { gi.halfResolution = true; }),
                     named("half resolution, paired", [](auto& gi) { gi.halfResolution = gi.pairedNeighbours = true; })},
                    64, 8);
}

using Lit = bool (*)(uint32_t x, uint32_t y, uint32_t frame);
bool onCheckerboard(uint32_t x, uint32_t y, uint32_t frame) { return (x + y + frame) % 2 == 1; }
bool inBlock(uint32_t x, uint32_t y, uint32_t frame) {
    constexpr std::array<std::array<uint32_t, 2>, 4> kTurns{{{0, 0}, {1, 1}, {1, 0}, {0, 1}}};
    return std::array{x % 2, y % 2} == kTurns[frame % 4];
}

// Of the pixels that frame `i` lights or does not light, the share that are, but for rounding, the mean of those around: of the lit
// ones, or for a lit one of the four beside it.
double filledShare(const samples::FloatImage& image, Lit isLit, uint32_t i, bool lit) {
    double filled = 0, all = 0;
    // Of the largest channel, which all are rounded by.
    const auto at = [&](uint32_t x, uint32_t y) { return image.rgb[3 * (size_t{y} * image.width + x)]; };
    for (uint32_t y = 1; y + 1 < image.height; ++y)
        for (uint32_t x = 1; x + 1 < image.width; ++x) {
            if (isLit(x, y, i) != lit) continue;
            float sum = 0, count = 0;
            for (uint32_t v = y - 1; v <= y + 1; ++v)
                for (uint32_t u = x - 1; u <= x + 1; ++u) {
                    if (lit ? (u == x) == (v == y) : !isLit(u, v, i)) continue;
                    sum += at(u, v);
                    ++count;
                }
            const float mean = sum / count;
            ++all;
            if (std::abs(at(x, y) - mean) <= mean / 32) ++filled;
        }
    return filled / all;
}

TEST(Gi, CellsAreLitInTurn) {
    samples::SceneData data = room({.color = kAlbedo, .roughness = 1, .specular = 0});
    const samples::View view = data.views[0];
    const samples::GpuScene scene(device(), std::move(data));
    HostView host(scene, view, {.maxExtent = kExtent, .indirect = true});
    for (bool blocks : {false, true}) {
        restir::Settings settings = indirect();
        settings.di.mode = restir::DirectMode::Off;
        settings.gi.checkerboard = !blocks;
        settings.gi.halfResolution = blocks;
        settings.gi.maxHistory = 0;   // noise, which tells who is lit
        settings.gi.spatialPasses = 0;
        const Lit isLit = blocks ? inBlock : onCheckerboard;
        host.newSession();
        for (uint32_t i = 0; i < 5; ++i) {
            const samples::FloatImage image = host.frame(host.input(i), settings);
            EXPECT_GT(filledShare(image, isLit, i, false), 0.6) << i << " " << blocks;   // all but those at an edge
            EXPECT_LT(filledShare(image, isLit, i, true), 0.3) << i << " " << blocks;
        }
    }
}

// The variance of a frame's pixels over independent sequences, relative to their squared mean.
double relativeVariance(HostView& host, const restir::Settings& settings, uint32_t frames) {
    constexpr uint32_t kSequences = 8;
    std::vector<double> sums, squares;
    for (uint32_t seed = 1; seed <= kSequences; ++seed) {
        for (uint32_t i = 0; i < frames; ++i) {
            restir::FrameInput input = host.input(i);
            input.seed = seed;
            input.resetHistory = i == 0;
            const samples::FloatImage image = host.frame(input, settings);
            if (i + 1 < frames) continue;
            sums.resize(image.rgb.size());
            squares.resize(image.rgb.size());
            for (size_t c = 0; c < image.rgb.size(); ++c) {
                sums[c] += image.rgb[c];
                squares[c] += double(image.rgb[c]) * image.rgb[c];
            }
        }
    }
    double variance = 0, square = 0;
    for (size_t c = 0; c < sums.size(); ++c) {
        const double mean = sums[c] / kSequences;
        variance += squares[c] / kSequences - mean * mean;
        square += mean * mean;
    }
    return variance / square;
}

// A cell's pixel of this frame finds what the one of the last frame found: the same bias, far less noise.
TEST(Gi, CellsHaveAHistory) {
    samples::SceneData data = room({.color = kAlbedo, .roughness = 1, .specular = 0});
    const samples::View view = data.views[0];
    const samples::GpuScene scene(device(), std::move(data));
    HostView host(scene, view, {.maxExtent = kExtent, .indirect = true});
    enum class Cell { Pixel, Pair, Block };
    for (Cell cell : {Cell::Pixel, Cell::Pair, Cell::Block}) {
        restir::Settings settings = indirect();
        settings.di.mode = restir::DirectMode::Off;
        settings.gi.checkerboard = cell == Cell::Pair;
        settings.gi.halfResolution = cell == Cell::Block;
        settings.gi.spatialPasses = 0;
        settings.gi.maxHistory = 8;
        const double with = relativeVariance(host, settings, 8);
        settings.gi.temporal = false;
        const double without = relativeVariance(host, settings, 8);
        std::printf("cells %d: relative variance %.4f with a history, %.4f without\n", int(cell), with, without);
        EXPECT_LT(with, 0.4 * without) << int(cell);
    }
}

// Half or a quarter of the pixels take as many of the rays, whatever direct light does.
TEST(Gi, PartOfThePixelsTakesPartOfTheRays) {
    samples::SceneData data = room({.color = kAlbedo, .roughness = 1, .specular = 0});
    const samples::View view = data.views[0];
    const samples::GpuScene scene(device(), std::move(data));
    HostView host(scene, view, {.maxExtent = kExtent, .indirect = true});
    enum class Part { All, Half, Quarter };
    const auto rays = [&](uint32_t frame, bool direct, Part part) {
        restir::Settings settings = indirect();
        settings.di.mode = direct ? restir::DirectMode::Restir : restir::DirectMode::Off;
        settings.counters = true;
        settings.gi.checkerboard = part == Part::Half;
        settings.gi.halfResolution = part == Part::Quarter;
        host.frame(host.input(frame), settings);
        return double(host.session().counters(frame % HostView::kSlots).rays);
    };
    const auto sequence = [&](bool direct, Part part) {
        host.newSession();
        for (uint32_t i = 0; i < 3; ++i) rays(i, direct, part);
        return rays(3, direct, part);
    };
    const double whole = sequence(false, Part::All), both = sequence(true, Part::All);
    for (Part part : {Part::Half, Part::Quarter}) {
        const double share = part == Part::Half ? 0.5 : 0.25;
        EXPECT_NEAR(sequence(false, part), whole * share, whole / 20);
        EXPECT_NEAR(rays(4, false, Part::All), whole, whole / 10);   // with only part of a history
        EXPECT_NEAR(sequence(true, part), both - whole * (1 - share), whole / 20);
    }
}

// Either of a pair asks for both.
TEST(Gi, PartnersTakeHalfOfTheRays) {
    samples::SceneData data = room({.color = kAlbedo, .roughness = 1, .specular = 0});
    const samples::View view = data.views[0];
    const samples::GpuScene scene(device(), std::move(data));
    HostView host(scene, view, {.maxExtent = kExtent, .pairedNeighbours = 5, .indirect = true});
    const auto rays = [&](uint32_t spatialPasses, bool paired) {
        restir::Settings settings = indirect();
        settings.di.mode = restir::DirectMode::Off;
        settings.gi.temporal = false;
        settings.gi.normalThreshold = -1;   // disc and squares accept alike
        settings.gi.depthThreshold = 1e9f;
        settings.gi.spatialPasses = spatialPasses;
        settings.gi.pairedNeighbours = paired;
        settings.counters = true;
        host.newSession();
        host.frame(host.input(0), settings);
        return double(host.session().counters(0).rays);
    };
    const double alone = rays(0, false), spatial = rays(1, false) - alone, paired = rays(1, true) - alone;
    EXPECT_NEAR(paired / spatial, 0.5, 0.05);
}

// A room of small lamps close to its walls: what few paths find stays in the history. Less error, for darkness of known size.
TEST(Gi, BoilingFilterTradesErrorForDarkness) {
    samples::SceneData scene;
    addRoom(scene, {.color = kAlbedo, .roughness = 1, .specular = 0}, {-2, 0, -2}, {2, 3, 2});
    Rng rng(5);
    for (uint32_t i = 0; i < 60; ++i)
        scene.punctual.push_back({.position = {rng.range(-1.9f, 1.9f), rng.range(2.7f, 2.9f), rng.range(-1.9f, 1.9f)},
                                  .intensity = glm::vec3(rng.range(0.02f, 0.1f))});
    scene.views.push_back({.eye = {0, 1.3f, 1.2f}, .target = {0, 0, 0.2f}, .verticalFov = 0.9f});
    World world(std::move(scene), kExtent);
    const samples::Sequence many{.view = world.view(), .frames = 4, .accumulate = true};
    const SeedStatistics reference = world.referenceSeeds(48, many, {.paths = 20, .bounces = 2});
    const ReferenceBlocks truth = referenceFromSeeds(reference);
    const auto against = [&](float strength, double& error) {
        restir::Settings settings = indirect();
        settings.gi.bounces = 2;
        settings.gi.lightCandidates = 1;
        settings.gi.treeShare = 0;
        settings.gi.boilingFilter = strength;
        SeedStatistics statistics;
        samples::Sequence sequence{.view = world.view(), .frames = kFrames};
        error = 0;
        for (sequence.seed = 1; sequence.seed <= 48; ++sequence.seed) {
            const samples::FloatImage image = world.render(sequence, settings);
            statistics.add(image);
            for (float v : image.rgb) error += double(v) * double(v);   // their means are the same, but for the bias
        }
        const Agreement agreement = compare(statistics, truth);
        print(("gi, boiling filter " + std::to_string(strength)).c_str(), agreement);
        std::printf("    mean square %.4f\n", error / 48 / double(kExtent.width * kExtent.height));
        return agreement;
    };
    double squaresOff = 0, squares = 0;
    const Agreement off = against(0, squaresOff), filtered = against(0.5f, squares);
    EXPECT_LE(off.worstZ, studentBound(off.blocks, 48));
    EXPECT_LT(squares, 0.9 * squaresOff);
    for (size_t c = 0; c < 3; ++c) {   // of direct and indirect light together
        EXPECT_LT(filtered.channelRatio[c], -6 * filtered.channelError[c]);
        EXPECT_GT(filtered.channelRatio[c], -0.15);
    }
}

// Where everything shines 1 and reflects a, n scatterings leave 1 + a + ... + a^n.
TEST(Gi, ClosedRoomThatShinesHasTheKnownRadiance) {
    samples::SceneData scene;
    addRoom(scene, {.color = kAlbedo, .roughness = 1, .emission = {1, 1, 1}, .specular = 0}, {-1, -1, -1},
            {1, 1, 1});
    scene.views.push_back({.eye = {0.3f, 0.2f, 0.6f}, .target = {-0.7f, -1, -1}, .verticalFov = 1});
    World world(std::move(scene), kExtent);
    glm::vec3 sum(1);
    for (uint32_t i = 0; i < kBounces; ++i) sum = 1.0f + kAlbedo * sum;
    samples::FloatImage truth{kExtent.width, kExtent.height, {}};
    for (uint32_t i = 0; i < kExtent.width * kExtent.height; ++i)
        truth.rgb.insert(truth.rgb.end(), {sum.x, sum.y, sum.z});
    expectAgreement(world, exactly(truth),
                    {kPath, kBoth, named("checkerboard", [](auto& gi) { gi.checkerboard = true; }),
                     named("half resolution", [](auto& gi) { gi.halfResolution = true; })});
}

double sumOf(const samples::FloatImage& image) {
    double sum = 0;
    for (float v : image.rgb) sum += double(v);
    return sum;
}

// The lamp of a closed room that reflects half goes out: nothing of it is left in the next frame, however
// often it was scattered, or as little as asked for. A second lamp stays, far dimmer.
TEST(Gi, LightThatGoesOutIsGoneAtOnce) {
    samples::SceneData walls;
    addRoom(walls, {.color = glm::vec3(0.5f), .roughness = 1, .specular = 0}, {-2, 0, -2}, {2, 3, 2});
    walls.views.push_back({.eye = {0, 1.3f, 1.95f}, .target = {0, 0.8f, 0}, .verticalFov = 0.9f});
    samples::GpuScene scene(device(), walls);
    HostView host(scene, walls.views[0], {.maxExtent = kExtent, .maxLights = 2, .indirect = true});
    const auto bulb = [](uint32_t id, float power) {
        restir::Light light{.id = id, .kind = restir::LightKind::Point, .position = {0.3f, 2, -0.4f}};
        for (float& v : light.emission) v = power;
        return light;
    };
    const auto afterwards = [&](uint32_t bounces, float stale) {
        restir::Settings settings = indirect();
        settings.di.mode = restir::DirectMode::Off;
        settings.gi.bounces = bounces;
        settings.gi.maxHistory = 8;
        settings.gi.staleHistory = stale;
        host.upload(std::array{bulb(0, 100), bulb(1, 1e-6f)});
        double before = 0, after = 0;
        for (uint32_t i = 0; i <= 10; ++i) {
            restir::FrameInput input = host.input(i);
            input.resetHistory = i == 0;
            if (i == 10) host.upload(std::array{bulb(1, 1e-6f)});
            (i < 10 ? before : after) = sumOf(host.frame(input, settings));
        }
        return after / before;
    };
    for (uint32_t bounces : {2u, 3u, 6u}) EXPECT_LT(afterwards(bounces, 0), 1e-6) << bounces;
    EXPECT_LT(afterwards(2, 1), 1e-6);
    const double echo = afterwards(6, 1);
    EXPECT_GT(echo, 0.05);
    EXPECT_LT(echo, 0.5);
}

// Boxes that slide, turn and hop: second vertices on them go, shadows on the walls do, and light scattered more often.
TEST(Gi, ThingsThatMoveAreFollowed) {
    constexpr uint32_t pictures = 80;
    World world(room({.color = kAlbedo, .roughness = 1, .specular = 0}), kExtent);
    samples::Sequence sequence{.view = world.view(), .frames = 9, .accumulate = true, .skip = 3, .jitter = false};
    sequence.motion = [](float time, samples::SceneState& state) {
        const glm::vec3 at{0.3f * std::sin(0.9f * time), 0.15f * std::abs(std::sin(0.7f * time)), 0};
        state.worldFromObject[1] = place(at, 0.15f * std::sin(0.8f * time));
    };
    const ReferenceBlocks truth =
        referenceFromSeeds(world.referenceSeeds(32, sequence, {.paths = 16, .bounces = kBounces}));
    SeedStatistics statistics;
    for (sequence.seed = 1000; sequence.seed < 1000 + pictures; ++sequence.seed)
        statistics.add(world.render(sequence, kBoth.settings));
    Verdict verdict(1, pictures);
    verdict.add("gi among what moves", compare(statistics, truth));
}

// With weights that do not ask for a sample's own target, too, light of old lights does not feed on itself.
TEST(Gi, ChangingLightsDoNotMultiply) {
    samples::SceneData walls = room({.color = kAlbedo, .roughness = 1, .specular = 0});
    samples::GpuScene scene(device(), walls);
    HostView host(scene, walls.views[0], {.maxExtent = kExtent, .indirect = true});
    const auto lastOf = [&](restir::Weights weights) {
        restir::Settings settings = indirect();
        settings.di.mode = restir::DirectMode::Off;
        settings.gi.weights = weights;
        double sum = 0;
        for (uint32_t i = 0; i < 16; ++i) {
            restir::FrameInput input = host.input(i);
            input.resetHistory = i == 0;
            host.upload(scene.lights());
            const double frame = sumOf(host.frame(input, settings));
            if (i >= 8) sum += frame;
        }
        return sum;
    };
    const double expected = lastOf(restir::Weights::PairwisePlain);
    EXPECT_LT(lastOf(restir::Weights::Basic), 2 * expected);
    EXPECT_LT(lastOf(restir::Weights::Off), 2 * expected);
}

TEST(Gi, NeedsItsMemoryDeclared) {
    World world(planeScene(), kExtent);
    samples::GpuScene scene(device(), planeScene());
    HostView host(scene, world.view(), {});
    const restir::FrameInput input = host.input(0);
    const auto plan = host.session().plan(input, indirect());
    ASSERT_FALSE(plan);
    EXPECT_EQ(plan.error().status, restir::Status::InvalidArgument);
    restir::Settings path = kPath.settings;
    path.gi.pairedNeighbours = true;   // of no use without reservoirs
    EXPECT_TRUE(host.session().plan(input, path));
    HostView unpaired(scene, world.view(), {.maxExtent = kExtent, .pairedNeighbours = 4, .indirect = true});
    EXPECT_FALSE(unpaired.session().plan(unpaired.input(0), kPaired.settings));
    restir::Settings four = kPaired.settings;
    four.gi.neighbours = 4;
    EXPECT_TRUE(unpaired.session().plan(unpaired.input(0), four));
}

}   // namespace
}   // namespace tests
