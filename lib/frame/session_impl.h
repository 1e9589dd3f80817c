#pragma once

#include <array>
#include <vector>

#include <device/buffers.h>
#include <device/stopwatch.h>
#include <frame/context_impl.h>
#include <frame/plan.h>
#include <restir/session.h>
#include <restir/shared/frame.h>
#include <restir/shared/gi.h>

namespace restir {

// Buffers of a Session, in this order; those of the frame slots follow.
enum class SessionBuffer : size_t {
    Surfaces0,
    Surfaces1,
    More0,
    More1,
    SurfacesFrame,
    Reservoirs0,
    Reservoirs1,
    Counters,
    RayLog,   // always there, so that the binding is: one ray where no log was asked for
    Notes,    // likewise: one word where pairedNeighbours is 0
    GiReservoirs0,   // likewise; the streams of A, then those of B
    GiReservoirsLast = GiReservoirs0 + size_t{2} * RS_GI_STREAMS - 1,
    FirstSlot,
};

// What the last recorded frame left behind.
struct History {
    bool direct = false, indirect = false;   // whether there are reservoirs of either
    uint32_t surfaces = 0;      // which of the two surface buffers holds it
    uint32_t reservoirs = 0, giReservoirs = 0;   // which of the two reservoir buffers
    VkExtent2D extent = {0, 0};
    gpu::RsView view{};
    uint64_t lights = 0;   // serial of the table it was drawn from, and that table's generation
    uint64_t lightGeneration = 0;
    uint64_t bvh = 0;   // likewise of the Bvh
    uint64_t bvhGeneration = 0;
    uint32_t field = 0, giField = 0;   // which pixels have reservoirs of either: restir/di/field.glsl
    VisibilityReuse visibility = VisibilityReuse::None, giVisibility = VisibilityReuse::None;   // whether samples were killed
};

struct Session::Impl {
    const Context::Impl* context = nullptr;
    SessionDesc desc;
    std::vector<BufferInfo> report;
    Buffers buffers;
    VkDescriptorPool pool = VK_NULL_HANDLE;
    std::vector<VkDescriptorSet> sets;   // by frame slot
    Stopwatch stopwatch;
    std::vector<uint8_t> counted;   // by frame slot: its last frame had Settings::counters
    History history;
    Plan plan;
    uint32_t preparedSlot = 0;                      // of the frame whose commands are to be recorded
    VkDescriptorSet preparedScene = VK_NULL_HANDLE;   // null: prepare() has not been called
    uint64_t preparedDone = 0;                        // bit i: pass i was recorded

    const Device& device() const noexcept { return context->device; }
    VkBuffer buffer(SessionBuffer b, uint32_t i = 0) const noexcept { return buffers.buffer(size_t(b) + i); }
    size_t constantsOf(uint32_t slot) const noexcept { return size_t(SessionBuffer::FirstSlot) + 2 * size_t(slot); }
    size_t readbackOf(uint32_t slot) const noexcept { return constantsOf(slot) + 1; }
    ~Impl();
};

inline constexpr uint32_t kMaxSpatialPasses = 8;
inline constexpr uint32_t kMaxNeighbours = 16;
inline constexpr uint32_t kMaxTimedPasses = 13 + 4 * kMaxSpatialPasses;   // of the longest plan

Result<bool> requirePasses(const Context::Impl& context, const Plan& plan) noexcept;   // their pipelines

std::vector<BufferRequest> sessionRequests(const Context::Impl& context, const SessionDesc& desc);

}   // namespace restir
