#include <frame/check.h>

#include <cmath>

#include <device/internals.h>
#include <lights/table_impl.h>
#include <rays/backend.h>
#include <rays/bvh_impl.h>
#include <scene/scene_impl.h>

namespace restir {
namespace {

bool allFinite(const float* values, size_t count) noexcept {
    for (size_t i = 0; i < count; ++i)
        if (!std::isfinite(values[i])) return false;
    return true;
}

Status checkCamera(const MessageSink& sink, const Camera& camera) noexcept {
    const float* v = camera.viewFromWorld.m;
    const float* p = camera.clipFromView.m;
    if (!allFinite(v, 16)) return refuse(sink, "restir: FrameInput::camera.viewFromWorld is not finite");
    if (!allFinite(p, 16)) return refuse(sink, "restir: FrameInput::camera.clipFromView is not finite");
    if (!allFinite(camera.jitter, 2)) return refuse(sink, "restir: FrameInput::camera.jitter is not finite");
    const double determinant = double(v[0]) * (double(v[5]) * v[10] - double(v[9]) * v[6]) -
                               double(v[4]) * (double(v[1]) * v[10] - double(v[9]) * v[2]) +
                               double(v[8]) * (double(v[1]) * v[6] - double(v[5]) * v[2]);
    if (determinant == 0) return refuse(sink, "restir: FrameInput::camera.viewFromWorld is singular");
    if (p[0] == 0 || p[5] == 0)
        return refuse(sink, "restir: FrameInput::camera.clipFromView has no extent in x or y");
    if (v[3] != 0 || v[7] != 0 || v[11] != 0 || v[15] != 1)
        return refuse(sink, "restir: FrameInput::camera.viewFromWorld is not affine");
    const bool perspective = std::abs(std::abs(p[11]) - 1) < 1e-4f && p[15] == 0;
    const bool orthographic = p[11] == 0 && p[15] == 1;
    if (!perspective && !orthographic)
        return refuse(sink,
                      "restir: FrameInput::camera.clipFromView has clip.w = %g z + %g, must be z, -z or 1",
                      double(p[11]), double(p[15]));
    if (p[1] != 0 || p[3] != 0 || p[4] != 0 || p[7] != 0)
        return refuse(sink,
                      "restir: FrameInput::camera.clipFromView mixes x and y, or puts them into clip.w");
    return Status::Ok;
}

// Refuses numbers outside their ranges; `of` is the struct they are fields of.
struct RangeCheck {
    const MessageSink& sink;
    const char* of;

    Status within(const char* name, uint32_t value, uint32_t low, uint32_t high) const noexcept {
        return value >= low && value <= high
                   ? Status::Ok
                   : refuse(sink, "restir: %s::%s is %u, must be in [%u, %u]", of, name, value, low, high);
    }
    // What any kind of reuse has.
    template <class S>
    Status reuse(const S& s, const SessionDesc& desc) const noexcept {
        if (Status status = within("lightCandidates", s.lightCandidates, 1, 65536); status != Status::Ok)
            return status;
        if (!(s.treeShare >= 0 && s.treeShare <= 0.9f))
            return refuse(sink, "restir: %s::treeShare is %g, must be in [0, 0.9]", of, double(s.treeShare));
        if (Status status = within("maxHistory", s.maxHistory, 0, 1000); status != Status::Ok) return status;
        if (Status status = within("spatialPasses", s.spatialPasses, 0, kMaxSpatialPasses);
            status != Status::Ok)
            return status;
        if (Status status = within("neighbours", s.neighbours, 1, kMaxNeighbours); status != Status::Ok)
            return status;
        if (!(s.radius > 0 && s.radius <= 1e4f))
            return refuse(sink, "restir: %s::radius is %g, must be in (0, 10000]", of, double(s.radius));
        if (!(s.normalThreshold >= -1 && s.normalThreshold <= 1))
            return refuse(sink, "restir: %s::normalThreshold is %g, must be in [-1, 1]", of,
                          double(s.normalThreshold));
        if (!(s.depthThreshold > 0))
            return refuse(sink, "restir: %s::depthThreshold is %g, must be > 0", of,
                          double(s.depthThreshold));
        if (s.weights > Weights::PairwisePlain)
            return refuse(sink, "restir: %s::weights is %d", of, int(s.weights));
        if (s.visibility > VisibilityReuse::Traced)
            return refuse(sink, "restir: %s::visibility is %d", of, int(s.visibility));
        if (!(s.boilingFilter >= 0 && s.boilingFilter <= 1))
            return refuse(sink, "restir: %s::boilingFilter is %g, must be in [0, 1]", of, double(s.boilingFilter));
        const bool reuses = s.mode == decltype(s.mode)::Restir;
        if (reuses && s.pairedNeighbours && s.neighbours > desc.pairedNeighbours)
            return refuse(sink, "restir: %s::pairedNeighbours with %u neighbours, SessionDesc::pairedNeighbours is %u", of,
                          s.neighbours, desc.pairedNeighbours);
        return Status::Ok;
    }
};

Status checkSettings(const MessageSink& sink, const DiSettings& di, const SessionDesc& desc) noexcept {
    const RangeCheck check{sink, "DiSettings"};
    if (Status s = check.reuse(di, desc); s != Status::Ok) return s;
    if (Status s = check.within("initialSamples", di.initialSamples, 1, 8); s != Status::Ok) return s;
    if (Status s = check.within("cutSamples", di.cutSamples, 1, 8); s != Status::Ok) return s;
    if (Status s = check.within("bsdfCandidates", di.bsdfCandidates, 0, 8); s != Status::Ok) return s;
    if (di.mode > DirectMode::Off) return refuse(sink, "restir: DiSettings::mode is %d", int(di.mode));
    return Status::Ok;
}

Status checkSettings(const MessageSink& sink, const GiSettings& gi, const SessionDesc& desc) noexcept {
    const RangeCheck check{sink, "GiSettings"};
    if (gi.mode > IndirectMode::Restir) return refuse(sink, "restir: GiSettings::mode is %d", int(gi.mode));
    if (gi.mode == IndirectMode::Restir && !desc.indirect)
        return refuse(sink, "restir: GiSettings::mode is Restir, SessionDesc::indirect is false");
    if (Status s = check.reuse(gi, desc); s != Status::Ok) return s;
    if (Status s = check.within("bounces", gi.bounces, 2, 64); s != Status::Ok) return s;
    if (!(gi.staleHistory >= 0 && gi.staleHistory <= 1))
        return refuse(sink, "restir: GiSettings::staleHistory is %g, must be in [0, 1]",
                      double(gi.staleHistory));
    if (gi.visibility == VisibilityReuse::None)
        return refuse(
            sink, "restir: GiSettings::visibility is None, must be Cached or Traced: every path is traced");
    return Status::Ok;
}

Status checkImages(const MessageSink& sink, const FrameInput& frame, const Settings& settings,
                   bool standardBridge) noexcept {
    const GBuffer& g = frame.gbuffer;
    if (standardBridge && !g.depth.view) return refuse(sink, "restir: FrameInput::gbuffer.depth is null");
    if (standardBridge && !g.normal.view) return refuse(sink, "restir: FrameInput::gbuffer.normal is null");
    if (standardBridge && !g.baseColor.view)
        return refuse(sink, "restir: FrameInput::gbuffer.baseColor is null");
    if (g.origin.x < 0 || g.origin.y < 0)
        return refuse(sink, "restir: FrameInput::gbuffer.origin is (%d, %d)", g.origin.x, g.origin.y);
    if (!frame.output.radiance) return refuse(sink, "restir: FrameInput::output.radiance is null");
    if (frame.output.gradient && settings.di.mode != DirectMode::Restir)
        return refuse(
            sink,
            "restir: FrameInput::output.gradient needs DirectMode::Restir, there are no reservoirs without");
    if (settings.gi.mode == IndirectMode::Off)
        for (const auto& [name, view] : {std::pair("indirectDiffuse", frame.output.indirectDiffuse),
                                         std::pair("indirectSpecular", frame.output.indirectSpecular)})
            if (view)
                return refuse(sink, "restir: FrameInput::output.%s needs a GiSettings::mode other than Off",
                              name);
    if (frame.output.origin.x < 0 || frame.output.origin.y < 0)
        return refuse(sink, "restir: FrameInput::output.origin is (%d, %d)", frame.output.origin.x,
                      frame.output.origin.y);
    if (g.normals > NormalEncoding::OctahedralUnorm)
        return refuse(sink, "restir: FrameInput::gbuffer.normals is %d", int(g.normals));
    if (g.depthKind > DepthKind::Linear)
        return refuse(sink, "restir: FrameInput::gbuffer.depthKind is %d", int(g.depthKind));
    if (!allFinite(g.motionScale, 2))
        return refuse(sink, "restir: FrameInput::gbuffer.motionScale is not finite");
    return Status::Ok;
}

Status checkDebug(const MessageSink& sink, const FrameInput& frame, const Settings& settings) noexcept {
    if (settings.debugView == DebugView::None) return Status::Ok;
    if (settings.debugView > DebugView::Duplicates)
        return refuse(sink, "restir: Settings::debugView is %d", int(settings.debugView));
    if (!frame.output.debug)
        return refuse(sink, "restir: FrameInput::output.debug is null, Settings::debugView needs it");
    if (settings.di.mode != DirectMode::Restir)
        return refuse(
            sink, "restir: Settings::debugView needs DirectMode::Restir, there are no reservoirs without");
    if (settings.debugView == DebugView::Neighbours && settings.di.spatialPasses == 0)
        return refuse(sink, "restir: Settings::debugView is Neighbours, but DiSettings::spatialPasses is 0");
    return Status::Ok;
}

Status checkStructure(const Session::Impl& s, const FrameInput& frame) noexcept {
    const MessageSink& sink = s.device().sink();
    if (tracesStructures(s.context->rays) && !frame.tlas) return refuse(sink, "restir: FrameInput::tlas is null");
    if (s.context->rays != RayBackend::Software) return Status::Ok;
    if (!frame.bvh) return refuse(sink, "restir: FrameInput::bvh is null, RayBackend::Software needs it");
    const Bvh::Impl& bvh = Internals::of(*frame.bvh);
    if (bvh.context != s.context) return refuse(sink, "restir: FrameInput::bvh is of another Context");
    if (bvh.generation == 0) return refuse(sink, "restir: FrameInput::bvh has no Bvh::record yet");
    return Status::Ok;
}

Status checkObjects(const Session::Impl& s, const FrameInput& frame) noexcept {
    const MessageSink& sink = s.device().sink();
    const LightTable::Impl& lights = Internals::of(*frame.lights);
    if (lights.context != s.context) return refuse(sink, "restir: FrameInput::lights is of another Context");
    if (lights.pending())
        return refuse(sink,
                      "restir: FrameInput::lights has an upload that LightTable::record has not recorded");
    if (!s.context->ownsSceneLayout)
        return frame.bridgeSet ? Status::Ok : refuse(sink, "restir: FrameInput::bridgeSet is null");
    if (!frame.scene) return refuse(sink, "restir: FrameInput::scene is null");
    const Scene::Impl& scene = Internals::of(*frame.scene);
    if (scene.context != s.context) return refuse(sink, "restir: FrameInput::scene is of another Context");
    if (lights.recorded.textures > scene.textures)
        return refuse(sink, "restir: FrameInput::lights uses texture %u, FrameInput::scene has %u",
                      lights.recorded.textures - 1, scene.textures);
    return Status::Ok;
}

}   // namespace

Status checkSettings(const Session::Impl& s, VkExtent2D e, const Settings& settings) noexcept {
    const MessageSink& sink = s.device().sink();
    const VkExtent2D max = s.desc.maxExtent;
    if (e.width == 0 || e.height == 0 || e.width > max.width || e.height > max.height)
        return refuse(sink, "restir: FrameInput::extent is %u x %u, maxExtent %u x %u", e.width, e.height,
                      max.width, max.height);
    if (Status status = checkSettings(sink, settings.di, s.desc); status != Status::Ok) return status;
    if (Status status = checkSettings(sink, settings.gi, s.desc); status != Status::Ok) return status;
    return Status::Ok;
}

Status checkFrame(const Session::Impl& s, const FrameInput& frame, const Settings& settings) noexcept {
    const MessageSink& sink = s.device().sink();
    if (frame.frameSlot >= s.context->framesInFlight)
        return refuse(sink, "restir: FrameInput::frameSlot is %u, framesInFlight is %u", frame.frameSlot,
                      s.context->framesInFlight);
    if (Status status = checkSettings(s, frame.extent, settings); status != Status::Ok) return status;
    if (!frame.lights) return refuse(sink, "restir: FrameInput::lights is null");
    if (Status status = checkStructure(s, frame); status != Status::Ok) return status;
    if (Status status = checkObjects(s, frame); status != Status::Ok) return status;
    if (!std::isfinite(frame.exposure) || frame.exposure < 0)
        return refuse(sink, "restir: FrameInput::exposure is %g", double(frame.exposure));
    if (Status status = checkImages(sink, frame, settings, s.context->ownsSceneLayout); status != Status::Ok)
        return status;
    if (Status status = checkCamera(sink, frame.camera); status != Status::Ok) return status;
    return checkDebug(sink, frame, settings);
}

namespace {

// What history names by light ids can be looked up: there are the lights of this frame and of the one before.
bool lightsKnown(const Session::Impl& s, const FrameInput& frame) noexcept {
    const LightTable::Impl& lights = Internals::of(*frame.lights);
    return s.history.lights == lights.serial && lights.generation - s.history.lightGeneration <= 1;
}

// Whether last frame's instances are still there, or have never been.
bool structureKnown(const Session::Impl& s, const FrameInput& frame) noexcept {
    if (s.context->rays != RayBackend::Software) return true;
    const Bvh::Impl& bvh = Internals::of(*frame.bvh);
    return s.history.bvh != bvh.serial || bvh.generation - s.history.bvhGeneration <= 1;
}

}   // namespace

bool historyUsable(const Session::Impl& s, const FrameInput& frame, const Settings& settings) noexcept {
    return s.history.direct && !frame.resetHistory && s.history.visibility == settings.di.visibility &&
           lightsKnown(s, frame) && structureKnown(s, frame);
}

bool giHistoryUsable(const Session::Impl& s, const FrameInput& frame, const Settings& settings) noexcept {
    return s.history.indirect && !frame.resetHistory && s.history.giVisibility == settings.gi.visibility &&
           lightsKnown(s, frame) && structureKnown(s, frame);
}

}   // namespace restir
