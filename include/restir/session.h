#pragma once

#include <restir/bvh.h>
#include <restir/frame.h>
#include <restir/lights.h>
#include <restir/scene.h>
#include <restir/settings.h>

namespace restir {

struct SessionDesc {
    VkExtent2D maxExtent = {0, 0};   // pixels; the largest FrameInput::extent
    // The most neighbours of a frame with DiSettings::pairedNeighbours or GiSettings::pairedNeighbours, at most 16; 0: no such
    // frames. Takes 4 (n / 2 + 1) bytes a pixel, n / 2 rounded down, and limits maxExtent where that is more than 16.
    uint32_t pairedNeighbours = 0;
    // Frames may have GiSettings::mode Restir. Takes 96 bytes a pixel.
    bool indirect = false;
    // Measuring only: frames with Settings::counters keep up to so many rays (32 bytes each) in rayLog().
    uint32_t rayLogCapacity = 0;
};

struct FrameInput {
    uint32_t frameSlot = 0;    // below framesInFlight; the GPU is done with the slot's last use
    uint64_t frameIndex = 0;   // with `seed` the only source of randomness: same values, same history, same bits
    uint32_t seed = 0;
    VkExtent2D extent = {0, 0};   // pixels, at most maxExtent; a change keeps history where surfaces match
    Camera camera;
    GBuffer gbuffer;
    VkAccelerationStructureKHR tlas = VK_NULL_HANDLE;   // required with RayBackend::RayQuery and Pipeline, else left alone
    // The structure of this Session's last recorded frame, alive and with that frame's geometry in it, which makes
    // VisibilityReuse::Traced unbiased while geometry moves. Null, or `tlas` again: nothing moved, or it is biased
    // while it does. Its instanceCustomIndex count the same records of Scene, whose current contents (alpha test) serve
    // both.
    VkAccelerationStructureKHR previousTlas = VK_NULL_HANDLE;
    // Required with RayBackend::Software, as of its last record(); what it held before serves as previousTlas does. In
    // place of last frame's Bvh: last frame's visibility is traced in the new one, as if nothing had moved.
    const Bvh* bvh = nullptr;
    const Scene* scene = nullptr;                       // required with the standard bridge
    VkDescriptorSet bridgeSet = VK_NULL_HANDLE;         // required with ContextDesc::bridgeSetLayout
    const LightTable* lights = nullptr;                 // required
    Output output;
    float exposure = 1;          // multiplies outputs, nothing else
    bool resetHistory = false;   // a camera cut, or a recorded frame that was never submitted: forget the past
};

enum class Access : uint8_t { Read, Write, ReadWrite };
enum class Resource : uint8_t {
    HostImages,
    Scene,
    Lights,
    Surfaces,
    PreviousSurfaces,
    ReservoirsA,
    ReservoirsB,
    Notes,   // of pair_targets for pair_spatial, of either kind of light
    GiReservoirsA,
    GiReservoirsB,
    Outputs,
    GradientOutput,
    DebugOutput,
};

// One dispatch. A frame is a list of these, known before anything is recorded.
struct PassInfo {
    const char* name = "";   // "di.temporal"; also the debug label, the timing and the file under passes/
    uint32_t groups[3] = {0, 0, 0};
    uint32_t source = 0, target = 0;   // reservoir buffer read and written: 0 is A, 1 is B
    uint32_t index = 0;                // among passes of the same name
    bool shades = false;               // adds what it found to the picture: di.* write the outputs, gi.* what those begin with
    struct Use {
        Resource resource = Resource::HostImages;
        Access access = Access::Read;
    };
    static constexpr uint32_t kMaxUses = 8;
    Use useList[kMaxUses] = {};
    uint32_t useCount = 0;
    std::span<const Use> uses() const noexcept { return {useList, useCount}; }
};

struct BufferInfo {
    const char* name = "";
    VkDeviceSize bytes = 0;
    bool perPixel = false;   // grows with maxExtent
};

struct Counters {
    uint32_t rays = 0;              // traced in the frame
    uint32_t rejectedWeights = 0;   // not finite or negative: stored as 0 instead
    uint32_t loggedRays = 0;
};

// One view's reservoirs and history. Use from one thread at a time. All frames of a Session and its LightTable are
// submitted in recording order on one queue of ContextDesc::queueFamily (or on several that semaphores order).
// Cheap beside a Context: a resize beyond maxExtent means
// making a new one.
class Session {
public:
    static Result<Session> create(const Context& context, const SessionDesc& desc) noexcept;
    // Exactly what create() will ask for, in bytes.
    static VkDeviceSize memoryNeeded(const Context& context, const SessionDesc& desc) noexcept;
    Session(Session&&) noexcept;
    Session& operator=(Session&&) noexcept;
    ~Session();   // the GPU is done with its last frame

    // Records a whole frame outside any render pass, with barriers between its own passes. Before: inputs made
    // available to inputScope(), earlier readers of the outputs included. After: outputs written in
    // outputScope(). Leaves the compute bind point with the SDK's pipeline and sets. On an error nothing was recorded and
    // the message sink names the field.
    [[nodiscard]] Status record(VkCommandBuffer cmd, const FrameInput& frame, const Settings& settings) noexcept;

    // The passes such a record() would dispatch. Does not advance history. The list lives until the next call.
    Result<std::span<const PassInfo>> plan(const FrameInput& frame, const Settings& settings) noexcept;

    // With PipelineCreation::OnDemand: makes the pipelines of such frames, after a cut or with history, so that none has to. Of
    // `frame` only extent and output are read: it may run (and compile, for seconds) beside the thread that uses the Session.
    [[nodiscard]] Status makePipelines(const FrameInput& frame, const Settings& settings) noexcept;

    // Instead of record(), for hosts with a render graph: everything of it but the commands, then each pass of the list by
    // recordPass() once, in any order and between any work of the host's that keeps their uses() apart as they are in the
    // list. Where a pass reads what an earlier one wrote, or writes what it used, the host puts a barrier from passScope()
    // to passScope(), and one before the first pass of a frame, behind the view's last frame; HostImages and outputs
    // take inputScope() and outputScope(), as around record(). Settings::counters needs record().
    Result<std::span<const PassInfo>> prepare(const FrameInput& frame, const Settings& settings) noexcept;
    // Pass `index` of the last prepare(). Binds everything itself and records no barrier.
    [[nodiscard]] Status recordPass(VkCommandBuffer cmd, uint32_t index) noexcept;

    // GPU time of the passes last recorded in `frameSlot`; call once the GPU is done with them. Empty where the
    // queue has no timestamps. The list lives until the next call.
    std::span<const PassTiming> timings(uint32_t frameSlot) noexcept;
    // Sums of that frame; all 0 where Settings::counters was off.
    Counters counters(uint32_t frameSlot) const noexcept;

    std::span<const BufferInfo> memory() const noexcept;   // what create() acquired
    VkBuffer rayLog() const noexcept;                      // gpu::RsLoggedRay[rayLogCapacity], or null

    static Scope inputScope(RayBackend rays = RayBackend::RayQuery) noexcept;
    static Scope outputScope(RayBackend rays = RayBackend::RayQuery) noexcept;
    static Scope passScope(RayBackend rays = RayBackend::RayQuery) noexcept;   // what passes do to the SDK's own buffers

    struct Impl;

private:
    explicit Session(std::unique_ptr<Impl> impl) noexcept;
    std::unique_ptr<Impl> impl_;
};

}   // namespace restir
