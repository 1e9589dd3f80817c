#pragma once

#include <memory>
#include <span>

#include <restir/context.h>
#include <restir/frame.h>
#include <restir/shared/scene.h>

namespace restir {

enum class LightKind : uint8_t { Triangle, Point, Spot, Directional };

// One light, in world space. Units as in glTF: what matters is only that all lights agree.
//
// With DiSettings::bsdfCandidates rays that hit a light count for part of its share, so every triangle light must be a
// triangle of the acceleration structure whose RsInstance::firstLight leads to it: the same corners in index order
// (barycentrics must agree; a mirrored instance needs its index order flipped), black where its material's alpha test
// fails, and not doubled by a coincident triangle (use twoSided). Lights that rays cannot hit: bsdfCandidates = 0.
struct Light {
    // Names the light across frames: below LightTableDesc::maxLights, unique in an upload, dense if memory and
    // table time matter. An id may name another light after one upload without it. RsInstance::firstLight
    // counts in ids.
    uint32_t id = 0;
    LightKind kind = LightKind::Triangle;
    bool twoSided = false;   // triangle: emits from its back, too

    float position[3] = {0, 0, 0};    // triangle: vertex 0
    float vertex1[3] = {0, 0, 0};     // triangle; counter-clockwise seen from the emitting side
    float vertex2[3] = {0, 0, 0};
    float direction[3] = {0, 0, -1};  // spot, directional: where the light travels, any length > 0
    float range = 0;                  // point, spot: metres, glTF's falloff reaches 0 there; 0: inverse square only
    float innerCone = 0;              // spot: half-angles in radians, 0 <= inner < outer <= pi / 2
    float outerCone = 0.785398163f;

    // Triangle: radiance, W / (sr m^2), times the texture. Point, spot: radiant intensity, W / sr. Directional:
    // irradiance on a plane facing it, W / m^2. Linear RGB, finite, >= 0.
    float emission[3] = {1, 1, 1};

    // Textured triangles: index into SceneDesc::textures, coordinates of the vertices, and the mean luminance of
    // emission x texture over the triangle, by which it is chosen. Negative: the untextured value. A triangle
    // whose mean is 0 is never chosen by the table, so it must be black.
    uint32_t texture = RS_NO_TEXTURE;
    float uv[3][2] = {};
    float meanLuminance = -1;
};

struct LightTableDesc {
    uint32_t maxLights = 0;   // one more than the largest id, at most 2^20; 0 is allowed
};

// The lights of a scene and the table to draw them from, shared by any number of Sessions. Externally
// synchronised. Frames that read it are submitted in recording order on one queue of ContextDesc::queueFamily.
class LightTable {
public:
    static Result<LightTable> create(const Context& context, const LightTableDesc& desc) noexcept;
    static VkDeviceSize memoryNeeded(const Context& context, const LightTableDesc& desc) noexcept;   // bytes
    LightTable(LightTable&&) noexcept;
    LightTable& operator=(LightTable&&) noexcept;
    ~LightTable();   // the GPU is done with its last frame

    // All lights of this frame; those not named are gone. The GPU is done with the slot's last use, and after a recorded
    // command buffer that was never submitted the lights must be uploaded again. Checks the lights and packs them into
    // the slot's staging memory, in one pass; record() must follow. On an error the message sink names the light and the
    // field, and the previous lights stay.
    [[nodiscard]] Status upload(uint32_t frameSlot, std::span<const Light> lights) noexcept;
    // Records the copy of the last upload and the passes that build the table to draw lights from, by their power; call
    // after every upload and before Session::record, outside any render pass. Without a new upload it records nothing.
    // Leaves the compute bind point with the SDK's pipeline and set.
    [[nodiscard]] Status record(VkCommandBuffer cmd, uint32_t frameSlot) noexcept;

    // As Session::timings(), of the last build recorded in `frameSlot`.
    std::span<const PassTiming> timings(uint32_t frameSlot) noexcept;

    struct Impl;

private:
    friend struct Internals;
    explicit LightTable(std::unique_ptr<Impl> impl) noexcept;
    std::unique_ptr<Impl> impl_;
};

}   // namespace restir
