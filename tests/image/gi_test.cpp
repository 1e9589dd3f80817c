// Indirect light against the reference path tracer, which shares no code with it.
#include <array>

#include <gtest/gtest.h>

#include "image/gi_room.h"

namespace tests {
namespace {

using namespace samples::build;

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

TEST(Gi, DiffuseRoomAgreesWithTheReference) {
    expectReference(room(matte()), allReuse());
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

// A room of small lamps close to its walls: what few paths find stays in the history. Less error, for darkness of known size.
TEST(Gi, BoilingFilterTradesErrorForDarkness) {
    samples::SceneData scene;
    addRoom(scene, matte(), {-2, 0, -2}, {2, 3, 2});
    Rng rng(5);
    for (uint32_t i = 0; i < 60; ++i)
        scene.punctual.push_back({.position = {rng.range(-1.9f, 1.9f), rng.range(2.7f, 2.9f), rng.range(-1.9f, 1.9f)},
                                  .intensity = glm::vec3(rng.range(0.02f, 0.1f))});
    scene.views.push_back({.eye = {0, 1.3f, 1.2f}, .target = {0, 0, 0.2f}, .verticalFov = 0.9f});
    World world(std::move(scene), kGiExtent);
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
        samples::Sequence sequence{.view = world.view(), .frames = kGiFrames};
        error = 0;
        for (sequence.seed = 1; sequence.seed <= 48; ++sequence.seed) {
            const samples::FloatImage image = world.render(sequence, settings);
            statistics.add(image);
            for (float v : image.rgb) error += double(v) * double(v);   // their means are the same, but for the bias
        }
        const Agreement agreement = compare(statistics, truth);
        print(("gi, boiling filter " + std::to_string(strength)).c_str(), agreement);
        std::printf("    mean square %.4f\n", error / 48 / double(kGiExtent.width * kGiExtent.height));
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
    World world(std::move(scene), kGiExtent);
    glm::vec3 sum(1);
    for (uint32_t i = 0; i < kGiBounces; ++i) sum = 1.0f + kAlbedo * sum;
    samples::FloatImage truth{kGiExtent.width, kGiExtent.height, {}};
    for (uint32_t i = 0; i < kGiExtent.width * kGiExtent.height; ++i)
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
    HostView host(scene, walls.views[0], {.maxExtent = kGiExtent, .maxLights = 2, .indirect = true});
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
    World world(room(matte()), kGiExtent);
    samples::Sequence sequence{.view = world.view(), .frames = 9, .accumulate = true, .skip = 3, .jitter = false};
    sequence.motion = [](float time, samples::SceneState& state) {
        const glm::vec3 at{0.3f * std::sin(0.9f * time), 0.15f * std::abs(std::sin(0.7f * time)), 0};
        state.worldFromObject[1] = place(at, 0.15f * std::sin(0.8f * time));
    };
    const ReferenceBlocks truth =
        referenceFromSeeds(world.referenceSeeds(32, sequence, {.paths = 16, .bounces = kGiBounces}));
    SeedStatistics statistics;
    for (sequence.seed = 1000; sequence.seed < 1000 + pictures; ++sequence.seed)
        statistics.add(world.render(sequence, kBoth.settings));
    Verdict verdict(1, pictures);
    verdict.add("gi among what moves", compare(statistics, truth));
}

// With weights that do not ask for a sample's own target, too, light of old lights does not feed on itself.
TEST(Gi, ChangingLightsDoNotMultiply) {
    samples::SceneData walls = room(matte());
    samples::GpuScene scene(device(), walls);
    HostView host(scene, walls.views[0], {.maxExtent = kGiExtent, .indirect = true});
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
    World world(planeScene(), kGiExtent);
    samples::GpuScene scene(device(), planeScene());
    HostView host(scene, world.view(), {});
    const restir::FrameInput input = host.input(0);
    const auto plan = host.session().plan(input, indirect());
    ASSERT_FALSE(plan);
    EXPECT_EQ(plan.error().status, restir::Status::InvalidArgument);
    restir::Settings path = kPath.settings;
    path.gi.pairedNeighbours = true;   // of no use without reservoirs
    EXPECT_TRUE(host.session().plan(input, path));
    HostView unpaired(scene, world.view(), {.maxExtent = kGiExtent, .pairedNeighbours = 4, .indirect = true});
    EXPECT_FALSE(unpaired.session().plan(unpaired.input(0), kPaired.settings));
    restir::Settings four = kPaired.settings;
    four.gi.neighbours = 4;
    EXPECT_TRUE(unpaired.session().plan(unpaired.input(0), four));
}

}   // namespace
}   // namespace tests
