// Session::record: the plan, put into the host's command buffer.
#include <cstring>

#include <device/barrier.h>
#include <device/internals.h>
#include <device/label.h>
#include <frame/check.h>
#include <frame/constants.h>
#include <frame/descriptors.h>
#include <lights/table_impl.h>
#include <rays/backend.h>
#include <rays/bvh_impl.h>
#include <scene/scene_impl.h>

namespace restir {
namespace {

constexpr VkPipelineStageFlags2 kTransfer = VK_PIPELINE_STAGE_2_TRANSFER_BIT;
constexpr VkAccessFlags2 kShaderWrite = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;
constexpr VkAccessFlags2 kShaderAccess = kShaderWrite | VK_ACCESS_2_SHADER_STORAGE_READ_BIT;

// Records one frame's passes; only lives during record().
class Recorder {
public:
    Recorder(Session::Impl& session, VkCommandBuffer cmd) noexcept
        : s_(session), f_(session.device().functions), cmd_(cmd), slot_(session.preparedSlot) {}

    void barrier(VkPipelineStageFlags2 from, VkAccessFlags2 wrote, VkPipelineStageFlags2 to, VkAccessFlags2 access) noexcept {
        memoryBarrier(f_, cmd_, {from, wrote}, {to, access});
    }

    // Behind the history of this view, the last readers of what is rewritten now, and the last use of the counters.
    void begin() noexcept {
        barrier(stages_ | kTransfer, kShaderWrite | VK_ACCESS_2_TRANSFER_WRITE_BIT, stages_ | kTransfer,
                kShaderAccess | VK_ACCESS_2_TRANSFER_WRITE_BIT);
    }

    void clearCounters() noexcept {
        f_.vkCmdFillBuffer(cmd_, s_.buffer(SessionBuffer::Counters), 0, VK_WHOLE_SIZE, 0);
        barrier(kTransfer, VK_ACCESS_2_TRANSFER_WRITE_BIT, stages_, kShaderAccess);
    }

    void readCounters() noexcept {
        barrier(stages_, kShaderWrite, kTransfer, VK_ACCESS_2_TRANSFER_READ_BIT);
        const VkBufferCopy all{.size = sizeof(gpu::RsCounters)};
        f_.vkCmdCopyBuffer(cmd_, s_.buffer(SessionBuffer::Counters), s_.buffers.buffer(s_.readbackOf(slot_)), 1, &all);
        barrier(kTransfer, VK_ACCESS_2_TRANSFER_WRITE_BIT, VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT);
    }

    void bind() noexcept {
        const VkDescriptorSet sets[] = {s_.sets[slot_], s_.preparedScene};
        f_.vkCmdBindDescriptorSets(cmd_, VK_PIPELINE_BIND_POINT_COMPUTE, s_.context->pipelineLayout, 0, 2, sets, 0, nullptr);
        if (s_.context->rays == RayBackend::Pipeline)
            f_.vkCmdBindDescriptorSets(cmd_, VK_PIPELINE_BIND_POINT_RAY_TRACING_KHR, s_.context->pipelineLayout, 0, 2, sets, 0,
                                       nullptr);
    }

    // The barrier that the passes since the last one ask for.
    void separate(const PassInfo& pass) noexcept {
        if (hazards_.conflicts(pass)) {
            barrier(stages_, kShaderWrite, stages_, kShaderAccess);
            hazards_ = {};
        }
        hazards_.add(pass);
    }

    void pass(const PassInfo& pass) noexcept {
        const Label label(f_, cmd_, pass.name);
        const PassPipelines::Entry& entry = s_.context->pipelines.of(pass.name);
        const bool traced = entry.traced >= 0;
        const VkPipelineStageFlags2 stage =
            traced ? VK_PIPELINE_STAGE_2_RAY_TRACING_SHADER_BIT_KHR : VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
        s_.stopwatch.start(cmd_, slot_, pass.name, stage);
        f_.vkCmdBindPipeline(cmd_, traced ? VK_PIPELINE_BIND_POINT_RAY_TRACING_KHR : VK_PIPELINE_BIND_POINT_COMPUTE,
                             entry.pipeline);
        const gpu::RsPass constants{.source = pass.source, .target = pass.target, .index = pass.index, .shades = pass.shades ? 1u : 0u};
        f_.vkCmdPushConstants(cmd_, s_.context->pipelineLayout, shaderStages(s_.context->rays), 0, sizeof constants, &constants);
        if (traced)
            s_.context->pipelines.trace(cmd_, entry, 8 * pass.groups[0], 8 * pass.groups[1]);
        else
            f_.vkCmdDispatch(cmd_, pass.groups[0], pass.groups[1], pass.groups[2]);
        s_.stopwatch.stop(cmd_, slot_, stage);
    }

private:
    Session::Impl& s_;
    const Functions& f_;
    VkCommandBuffer cmd_;
    uint32_t slot_;
    VkPipelineStageFlags2 stages_ = s_.device().passStages;
    Hazards hazards_;
};

void recordPasses(Session::Impl& s, VkCommandBuffer cmd, bool counters) noexcept {
    Recorder recorder(s, cmd);
    const Label label(s.device().functions, cmd, "restir");
    recorder.begin();
    if (counters) recorder.clearCounters();
    recorder.bind();
    for (const PassInfo& pass : s.plan.passes) {
        recorder.separate(pass);
        recorder.pass(pass);
    }
    if (counters) recorder.readCounters();
}

// All of a frame but its commands: plan, constants, descriptors, and the history that it leaves.
Result<bool> prepareFrame(Session& session, Session::Impl& s, const FrameInput& frame, const Settings& settings) noexcept {
    if (auto planned = session.plan(frame, settings); !planned) return planned.error();
    if (auto made = requirePasses(*s.context, s.plan); !made) return made;
    const LightTable::Impl& lights = Internals::of(*frame.lights);
    const bool history = historyUsable(s, frame, settings), giHistory = giHistoryUsable(s, frame, settings);
    const uint32_t surfaces = 1 - s.history.surfaces;

    const gpu::RsFrame constants = makeConstants(s, frame, settings, history, giHistory);
    std::memcpy(s.buffers.mapped<uint8_t>(s.constantsOf(frame.frameSlot)), &constants, sizeof constants);
    const bool sameLights = !(history || giHistory) || lights.generation == s.history.lightGeneration;
    writeDescriptors(s, frame, surfaces, sameLights ? lights.current() : lights.previous());
    const Bvh::Impl* bvh = s.context->rays == RayBackend::Software ? &Internals::of(*frame.bvh) : nullptr;
    s.preparedSlot = frame.frameSlot;
    s.preparedScene = s.context->ownsSceneLayout ? Internals::of(*frame.scene).set : frame.bridgeSet;
    s.preparedDone = 0;
    s.stopwatch.reset(frame.frameSlot);
    s.counted[frame.frameSlot] = settings.counters;
    s.history = {.direct = settings.di.mode == DirectMode::Restir,
                 .indirect = settings.gi.mode == IndirectMode::Restir,
                 .surfaces = surfaces,
                 .reservoirs = s.plan.historyOut,
                 .giReservoirs = s.plan.giHistoryOut,
                 .extent = frame.extent,
                 .view = constants.view,
                 .lights = lights.serial,
                 .lightGeneration = lights.generation,
                 .bvh = bvh ? bvh->serial : 0,
                 .bvhGeneration = bvh ? bvh->generation : 0,
                 .field = constants.di.field,
                 .giField = constants.gi.field,
                 .visibility = settings.di.visibility,
                 .giVisibility = settings.gi.visibility};
    return true;
}

}   // namespace

Status Session::record(VkCommandBuffer cmd, const FrameInput& frame, const Settings& settings) noexcept {
    Impl& s = *impl_;
    if (!cmd) return refuse(s.device().sink(), "restir: Session::record: cmd is null");
    if (auto prepared = prepareFrame(*this, s, frame, settings); !prepared) return prepared.error().status;
    recordPasses(s, cmd, settings.counters);
    s.preparedScene = VK_NULL_HANDLE;   // recordPass() is for prepare()
    return Status::Ok;
}

Result<std::span<const PassInfo>> Session::prepare(const FrameInput& frame, const Settings& settings) noexcept {
    Impl& s = *impl_;
    if (settings.counters)
        return Error{refuse(s.device().sink(), "restir: Settings::counters needs Session::record"), VK_SUCCESS,
                     "FrameInput or Settings is invalid"};
    if (auto prepared = prepareFrame(*this, s, frame, settings); !prepared) return prepared.error();
    return std::span<const PassInfo>(s.plan.passes);
}

Status Session::recordPass(VkCommandBuffer cmd, uint32_t index) noexcept {
    Impl& s = *impl_;
    const MessageSink& sink = s.device().sink();
    if (!cmd) return refuse(sink, "restir: Session::recordPass: cmd is null");
    if (!s.preparedScene) return refuse(sink, "restir: Session::recordPass without Session::prepare");
    if (index >= s.plan.passes.size())
        return refuse(sink, "restir: Session::recordPass: index is %u, the plan has %zu passes", index, s.plan.passes.size());
    if (s.preparedDone >> index & 1) return refuse(sink, "restir: Session::recordPass: pass %u is recorded already", index);
    s.preparedDone |= uint64_t(1) << index;
    Recorder recorder(s, cmd);
    recorder.bind();
    recorder.pass(s.plan.passes[index]);
    return Status::Ok;
}

}   // namespace restir
