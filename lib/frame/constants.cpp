#include <frame/constants.h>

#include <algorithm>
#include <cmath>

#include <glm/glm.hpp>

#include <device/internals.h>
#include <lights/table_impl.h>
#include <rays/bvh_impl.h>

namespace restir {
namespace {

gpu::vec3 toVec3(glm::dvec3 v) noexcept { return {float(v.x), float(v.y), float(v.z)}; }

// SplitMix64's finaliser (Steele et al. 2014): every bit of both inputs reaches every bit of the seed.
uint32_t seedOf(uint64_t frameIndex, uint32_t seed) noexcept {
    uint64_t z = frameIndex * 0x9e3779b97f4a7c15u + (uint64_t(seed) << 32 | 0x5851f42du);
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return uint32_t(z ^ z >> 31);
}

uint32_t flagsOf(const FrameInput& frame, const Settings& settings, bool history) noexcept {
    uint32_t flags = history ? RS_FRAME_HISTORY : 0u;
    if (frame.gbuffer.motion.view) flags |= RS_FRAME_MOTION;
    if (frame.gbuffer.geometricNormal.view) flags |= RS_FRAME_GEOMETRIC_NORMAL;
    if (frame.gbuffer.material.view) flags |= RS_FRAME_MATERIAL;
    if (frame.gbuffer.emission.view) flags |= RS_FRAME_EMISSION;
    if (frame.gbuffer.depthKind == DepthKind::Linear) flags |= RS_FRAME_LINEAR_DEPTH;
    if (frame.output.diffuse) flags |= RS_FRAME_DIFFUSE;
    if (frame.output.specular) flags |= RS_FRAME_SPECULAR;
    if (frame.output.indirectDiffuse) flags |= RS_FRAME_INDIRECT_DIFFUSE;
    if (frame.output.indirectSpecular) flags |= RS_FRAME_INDIRECT_SPECULAR;
    if (settings.counters) flags |= RS_FRAME_COUNT;
    if (settings.gi.mode != IndirectMode::Off) flags |= RS_FRAME_INDIRECT;
    if (showsOwnPath(settings.gi)) flags |= RS_FRAME_OWN_PATH;
    return flags;
}

// Two points of a square with edge n are n^2 / 3 apart in the mean square, points of a disc r^2 / 2 from its
// centre; in squares of pairs of pixels, 2 n by n, 5 n^2 / 6; of blocks, 4 n^2 / 3.
uint32_t partnerSquare(float radius, Cell cell) noexcept {
    constexpr float kHalfEdge[] = {0.61237f, 0.38730f, 0.30619f};
    return 2 * std::max(uint32_t(std::lround(radius * kHalfEdge[size_t(cell)])), 1u);
}

// Another pixel of each cell than last time, in turns: restir/di/field.glsl.
uint32_t fieldOf(Cell cell, uint32_t last) noexcept {
    if (cell == Cell::Pixel) return RS_FIELD_ALL;
    if (cell == Cell::Pair) return last == RS_FIELD_PAIRS ? RS_FIELD_PAIRS + 1 : RS_FIELD_PAIRS;
    constexpr uint32_t kAfter[] = {3, 2, 0, 1};   // across, then up, then across
    return RS_FIELD_BLOCKS + (last < RS_FIELD_BLOCKS ? 0 : kAfter[last - RS_FIELD_BLOCKS]);
}

// What any kind of reuse has.
template <class S>
gpu::RsDiConstants reuseConstants(const S& s) noexcept {
    return {.lightCandidates = s.lightCandidates,
            .maxHistory = s.maxHistory,
            .neighbours = s.neighbours,
            .radius = s.radius,
            .normalThreshold = s.normalThreshold,
            .depthThreshold = s.depthThreshold,
            .weights = uint32_t(s.weights),
            .visibility = uint32_t(s.visibility),
            .boilingFilter = s.boilingFilter,
            .freshConfidence = 1};
}

gpu::RsDiConstants diConstants(const DiSettings& di, bool history, Cell cell) noexcept {
    const bool cut = di.temporal && !history;
    gpu::RsDiConstants c = reuseConstants(di);
    c.bsdfCandidates = di.bsdfCandidates;
    c.initialSamples = cut ? std::max(di.initialSamples, di.cutSamples) : di.initialSamples;
    c.partnerSquare = partnerSquare(di.radius, cell);
    c.freshConfidence =
        c.initialSamples / di.initialSamples;   // what the next frames' candidates are weighed against
    return c;
}

// What traces then and now; FrameInput::previousTlas says of itself that things moved.
struct Structures {
    bool moved;
    uint32_t root = 0, previousRoot = 0;   // of a Bvh
};

Structures structuresOf(const Session::Impl& s, const FrameInput& frame) noexcept {
    if (s.context->rays != RayBackend::Software) return {frame.previousTlas && frame.previousTlas != frame.tlas};
    const Bvh::Impl& bvh = Internals::of(*frame.bvh);
    const bool moved = s.history.bvh == bvh.serial && s.history.bvhGeneration != bvh.generation;
    return {moved, bvh.root(), moved ? bvh.previousRoot() : bvh.root()};
}

}   // namespace

gpu::RsView makeView(const Camera& camera, VkExtent2D extent) noexcept {
    const float* v = camera.viewFromWorld.m;
    const float* p = camera.clipFromView.m;
    gpu::RsView view{};
    for (int row = 0; row < 3; ++row) view.viewFromWorld[row] = {v[row], v[4 + row], v[8 + row], v[12 + row]};
    glm::dmat3 axes;
    for (size_t column = 0; column < 3; ++column)
        axes[int(column)] = {double(v[4 * column]), double(v[4 * column + 1]), double(v[4 * column + 2])};
    const glm::dmat3 inverse = glm::inverse(axes);
    view.axisX = toVec3(inverse[0]);
    view.axisY = toVec3(inverse[1]);
    view.axisZ = toVec3(inverse[2]);
    view.eye = toVec3(-(inverse * glm::dvec3(v[12], v[13], v[14])));
    const bool perspective = p[11] != 0;
    view.zSign = p[11] > 0 ? 1.0f : -1.0f;
    view.perspective = perspective ? 1.0f : 0.0f;
    view.projection = {p[0], p[5], p[8] * view.zSign, p[9] * view.zSign};
    view.translation = {p[12], p[13]};
    view.depthTerms = {p[10], p[14], p[11], p[15]};
    view.jitter = {2 * camera.jitter[0] / float(extent.width), 2 * camera.jitter[1] / float(extent.height)};
    return view;
}

gpu::RsFrame makeConstants(const Session::Impl& s, const FrameInput& frame, const Settings& settings,
                           bool history, bool giHistory) noexcept {
    const LightTable::Impl& lights = Internals::of(*frame.lights);
    const bool past = history || giHistory;
    const bool lightsChanged = past && lights.generation != s.history.lightGeneration;
    const GBuffer& g = frame.gbuffer;
    gpu::RsFrame c{};
    c.view = makeView(frame.camera, frame.extent);
    c.previousView = past ? s.history.view : c.view;
    c.extent = {frame.extent.width, frame.extent.height};
    c.previousExtent = past ? gpu::uvec2{s.history.extent.width, s.history.extent.height} : c.extent;
    c.gbufferOrigin = {uint32_t(g.origin.x), uint32_t(g.origin.y)};
    c.outputOrigin = {uint32_t(frame.output.origin.x), uint32_t(frame.output.origin.y)};
    c.seed = seedOf(frame.frameIndex, frame.seed);
    c.lightCount = lights.recorded.count;
    c.previousLightCount = lightsChanged ? lights.previousCount : lights.recorded.count;
    c.flags = flagsOf(frame, settings, history);
    c.emptyDepth = g.emptyDepth;
    c.exposure = frame.exposure;
    c.motionScale = {g.motionScale[0], g.motionScale[1]};
    c.normalEncoding = uint32_t(g.normals);
    c.rayLogCapacity = s.desc.rayLogCapacity;
    c.debugView = uint32_t(settings.debugView);
    c.environmentExtent = lights.environment.extent();
    const auto& found = lights.recorded.found;
    c.infiniteLights = {found[0], found[1], found[2], found[3]};
    const Cell cell = cellOf(frame.extent, settings.di);
    c.di = diConstants(settings.di, history, cell);
    c.di.previousField = history ? s.history.field : 0;
    c.di.field = fieldOf(cell, c.di.previousField);
    if (settings.di.permuteHistory) c.di.permutation = 16u | (c.seed & 15u);
    c.gi = reuseConstants(settings.gi);
    const Cell giCell = cellOf(frame.extent, settings.gi);
    c.gi.partnerSquare = partnerSquare(settings.gi.radius, giCell);
    c.gi.previousField = giHistory ? s.history.giField : 0;
    c.gi.field = fieldOf(giCell, c.gi.previousField);
    c.giScratch = 1 - s.history.reservoirs;
    if (lights.hasTree) {
        c.di.treeShare = settings.di.treeShare;
        c.gi.treeShare = settings.gi.treeShare;
    }
    c.giBounces = settings.gi.bounces;
    const Structures structures = structuresOf(s, frame);
    const bool moved = past && structures.moved;
    if (moved) c.flags |= RS_FRAME_MOVED;
    c.giStale = lightsChanged || moved ? settings.gi.staleHistory : 1.0f;
    c.bvhRoot = structures.root;
    c.bvhPreviousRoot = structures.previousRoot;
    return c;
}

}   // namespace restir
