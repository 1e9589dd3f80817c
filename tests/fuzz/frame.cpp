// Frames and settings that no host would hand over, through everything of a Session that takes them.
#include <cstdlib>

#include "fuzz/null_host.h"
#include "fuzz/take.h"
#include "fuzz/target.h"

namespace fuzz {
namespace {

restir::LightTable& lights() {
    static restir::Result<restir::LightTable> made = [] {
        auto table = restir::LightTable::create(context(), {.maxLights = 1});
        const restir::Light lamp{.kind = restir::LightKind::Point};
        if (table->upload(0, {&lamp, 1}) != restir::Status::Ok) std::abort();
        if (table->record(someHandle<VkCommandBuffer>(), 0) != restir::Status::Ok) std::abort();
        return table;
    }();
    return *made;
}

restir::FrameInput goodFrame(VkExtent2D extent) {
    const restir::Image image{someHandle<VkImageView>()};
    restir::FrameInput frame{.extent = extent,
                             .gbuffer = {.depth = image, .normal = image, .baseColor = image},
                             .tlas = someHandle<VkAccelerationStructureKHR>(),
                             .scene = &scene(),
                             .lights = &lights(),
                             .output = {.radiance = image.view}};
    frame.camera.clipFromView.m[11] = -1;
    frame.camera.clipFromView.m[15] = 0;
    return frame;
}

void takeView(Take& take, VkImageView& view) {
    if (take.value<uint8_t>() >= 0xc0) view = take.flag() ? someHandle<VkImageView>() : VK_NULL_HANDLE;
}

void takeFrame(Take& take, restir::FrameInput& frame) {
    take.maybe(frame.frameSlot, frame.frameIndex, frame.seed, frame.extent.width, frame.extent.height,
               frame.exposure, frame.resetHistory, frame.camera.viewFromWorld.m, frame.camera.clipFromView.m,
               frame.camera.jitter);
    for (float& element : frame.camera.viewFromWorld.m) take.maybe(element);
    for (float& element : frame.camera.clipFromView.m) take.maybe(element);
    restir::GBuffer& g = frame.gbuffer;
    for (restir::Image* image :
         {&g.depth, &g.normal, &g.geometricNormal, &g.baseColor, &g.material, &g.motion, &g.emission})
        takeView(take, image->view);
    take.maybe(g.normals, g.depthKind, g.emptyDepth, g.motionScale, g.origin.x, g.origin.y);
    restir::Output& o = frame.output;
    for (VkImageView* view : {&o.radiance, &o.diffuse, &o.specular, &o.indirectDiffuse, &o.indirectSpecular,
                              &o.gradient, &o.debug})
        takeView(take, *view);
    take.maybe(o.origin.x, o.origin.y);
    if (take.value<uint8_t>() == 0xff) frame.scene = nullptr;
    if (take.value<uint8_t>() == 0xff) frame.lights = nullptr;
    if (take.value<uint8_t>() == 0xff) frame.tlas = VK_NULL_HANDLE;
    if (take.flag()) frame.previousTlas = frame.tlas;
}

void takeSettings(Take& take, restir::Settings& settings) {
    restir::DiSettings& di = settings.di;
    if (take.value<uint8_t>() >= 0xc0) {
        const auto preset = restir::Preset(take.below(5));
        settings = {.di = restir::presetSettings(preset), .gi = restir::presetIndirect(preset)};
    }
    take.maybe(di.mode, di.lightCandidates, di.initialSamples, di.cutSamples, di.bsdfCandidates, di.treeShare,
               di.temporal, di.maxHistory, di.permuteHistory, di.spatialPasses, di.neighbours, di.fused,
               di.checkerboard, di.radius, di.pairedNeighbours, di.normalThreshold, di.depthThreshold,
               di.weights, di.visibility, di.averageShading, di.boilingFilter);
    restir::GiSettings& gi = settings.gi;
    if (take.flag()) gi.mode = restir::IndirectMode(take.below(3));
    take.maybe(gi.mode, gi.bounces, gi.lightCandidates, gi.treeShare, gi.temporal, gi.maxHistory,
               gi.staleHistory, gi.spatialPasses, gi.neighbours, gi.radius, gi.pairedNeighbours, gi.normalThreshold,
               gi.depthThreshold, gi.checkerboard, gi.halfResolution, gi.weights, gi.visibility, gi.averageShading,
               gi.ownPath, gi.boilingFilter);
    take.maybe(settings.debugView, settings.counters);
}

// All passes of the plan, some of them twice or in no order.
void recordPasses(Take& take, restir::Session& session, size_t count) {
    const auto cmd = someHandle<VkCommandBuffer>();
    for (uint32_t i = 0; i < count; ++i) {
        uint32_t index = i;
        take.maybe(index);
        (void)session.recordPass(cmd, index);
    }
}

void run(std::span<const uint8_t> bytes) {
    Take take(bytes);
    restir::SessionDesc desc{
        .maxExtent = {64, 48}, .pairedNeighbours = take.below(18), .indirect = take.flag()};
    take.maybe(desc.maxExtent.width, desc.maxExtent.height, desc.rayLogCapacity);
    auto session = restir::Session::create(context(), desc);
    if (!session) return;
    restir::FrameInput frame = goodFrame({64, 48});
    restir::Settings settings;
    while (!take.empty()) {
        ++frame.frameIndex;
        takeFrame(take, frame);
        takeSettings(take, settings);
        const uint32_t way = take.below(4);
        if (way == 0) {
            if (const auto plan = session->plan(frame, settings); plan && plan->empty()) std::abort();
        } else if (way == 1) {
            if (const auto plan = session->prepare(frame, settings))
                recordPasses(take, *session, plan->size());
        } else if (session->record(someHandle<VkCommandBuffer>(), frame, settings) == restir::Status::Ok) {
            (void)session->timings(frame.frameSlot);
            (void)session->counters(frame.frameSlot);
        } else {   // the next one starts from good values again
            frame = goodFrame({64, 48});
            settings = {};
        }
    }
}

// Frames as they should be, with and without indirect light, long enough for a history.
std::vector<Bytes> seeds() {
    Bytes direct{16, 0}, both{0, 1};
    direct.insert(direct.end(), 400, 0);
    both.insert(both.end(), 400, 2);
    Bytes recorded = both;
    for (size_t i = 3; i < recorded.size(); i += 3) recorded[i] = 3;
    return {direct, both, recorded};
}

}   // namespace

const Target kFrame{"frame", run, seeds};

}   // namespace fuzz
