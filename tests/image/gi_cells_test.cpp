// Indirect light of part of the pixels: which are lit, what the others are filled in with, and how many rays that takes.
#include <array>

#include <gtest/gtest.h>

#include "image/gi_room.h"

namespace tests {
namespace {

using namespace samples::build;

// The floor of a room one wall of which shines. What direct light would be if it were blurred as well is the same to a
// fraction of a thousandth.
TEST(Gi, PartOfThePixelsBlursByAPixelAndNoMore) {
    samples::SceneData scene;
    addRoom(scene, matte(), {-2, 0, -2}, {2, 3, 2});
    addQuad(scene, {.origin = {-1.99f, 0.1f, -1.9f}, .u = {0, 2.8f, 0}, .v = {0, 0, 3.8f}},
            {.color = {0, 0, 0}, .emission = {6, 5, 4}, .specular = 0});
    scene.views.push_back({.eye = {0, 1.3f, 1.2f}, .target = {0, 0, 0.2f}, .verticalFov = 0.9f});
    World world(std::move(scene), kGiExtent);
    samples::Sequence sequence{.view = world.view(), .frames = 4, .accumulate = true};
    SeedStatistics halves, blocks;
    for (sequence.seed = 1; sequence.seed <= 32; ++sequence.seed) {
        const samples::FloatImage reference = world.reference(sequence, {.paths = 20, .bounces = kGiBounces});
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
    RoomHost inRoom;
    HostView& host = inRoom.view;
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
    RoomHost inRoom;
    HostView& host = inRoom.view;
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
    RoomHost inRoom;
    HostView& host = inRoom.view;
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
    RoomHost inRoom(5);
    HostView& host = inRoom.view;
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

}   // namespace
}   // namespace tests
