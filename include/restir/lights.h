#pragma once

#include <memory>
#include <span>

#include <restir/context.h>
#include <restir/frame.h>
#include <restir/scene.h>

namespace restir {

enum class LightKind : uint8_t {
    Triangle,
    Point,
    Spot,
    Directional,
    Sphere,
    Capsule,     // all within a radius of a segment: a tube with round ends
    Rectangle,   // or any parallelogram
    Disk,
    Environment,   // the sky: an equirectangular map
};

// One light, in world space. Units as in glTF: what matters is only that all lights agree.
//
// What rays find. With DiSettings::bsdfCandidates rays that hit a triangle light, or leave the scene towards
// the environment or a directional light with an extent, count for part of its share. So
// - Every triangle light must be a triangle of the acceleration structure whose RsInstance::firstLight leads
//   to it: the same corners in index order (barycentrics must agree; a mirrored instance needs its index
//   order flipped), black where its material's alpha test fails, and not doubled by a coincident triangle
//   (use twoSided). Lights that rays cannot hit: bsdfCandidates = 0.
// - Spheres, capsules, rectangles and disks are in no acceleration structure: they neither block light nor
//   show in mirrors, and only being drawn finds them, noisily in what is nearly a mirror. A host that shows a
//   lamp's body puts it behind or inside the light, or keeps it from rays. They emit outwards: a sphere
//   around a receiver does not light it.
// A light without area, or behind what it shines on, adds nothing.
struct Light {
    // Names the light across frames: below LightTableDesc::maxLights, unique in an upload, dense if memory
    // and table time matter. An id may name another light after one upload without it. RsInstance::firstLight
    // counts in ids.
    uint32_t id = 0;
    LightKind kind = LightKind::Triangle;
    bool twoSided = false;   // triangle, rectangle, disk: emits from its back, too

    // Triangle: vertex 0. Rectangle: a corner. Capsule: one end of its axis. Sphere, disk: the centre.
    float position[3] = {0, 0, 0};
    // Triangle: vertices 1 and 2, counter-clockwise seen from the emitting side. Rectangle: the corners next
    // to `position`, likewise; the fourth is vertex1 + vertex2 - position. Capsule: vertex1 is the other end
    // of its axis.
    float vertex1[3] = {0, 0, 0};
    float vertex2[3] = {0, 0, 0};
    // Spot, directional: where the light travels. Disk: which way it faces. Any length > 0.
    float direction[3] = {0, 0, -1};
    float radius = 0;      // sphere, disk, capsule: metres, [0, 1e9]
    float range = 0;       // point, spot: metres, glTF's falloff reaches 0 there; 0: inverse square only
    float innerCone = 0;   // spot: half-angles in radians, 0 <= inner < outer <= pi / 2
    float outerCone = 0.785398163f;
    // Directional: half the angle it is seen under, radians, [0, pi / 2]; the sun's is 0.00465. Does not
    // change the irradiance. At most RS_INFINITE_LIGHTS directional lights of some extent and environments at
    // a time.
    float angularRadius = 0;
    // Environment: unit quaternion (x, y, z, w) that turns the map's axes into the world's. In the map's, y
    // is up and a direction d is at u = 0.5 + atan2(d.z, d.x) / (2 pi), v = acos(d.y) / pi, (0, 0) being the
    // map's top left corner. Point, spot: likewise of its profile, in whose axes light that travels along d
    // is at u = atan2(d.y, d.x) / (2 pi), v = acos(-d.z) / pi: photometry's horizontal and vertical angle
    // (type C), the lamp looking down -z.
    // Of a spot -z is `direction`, and the rotation only says where x is.
    float rotation[4] = {0, 0, 0, 1};

    // Triangle, rectangle: radiance, W / (sr m^2), times the texture. Sphere, capsule, disk: radiance. Point,
    // spot: radiant intensity, W / sr. Directional: irradiance on a plane facing it, W / m^2. Environment:
    // factor on the map, whose texels are radiance. Linear RGB, [0, 1e30].
    float emission[3] = {1, 1, 1};

    // Index into SceneDesc::textures. Triangle, rectangle: or none; uv are the coordinates of position,
    // vertex1 and vertex2, and meanLuminance that of emission x texture over the light, by which it is
    // chosen; negative: the untextured value. One whose mean is 0 is never chosen by the table, so it must be
    // black. Point, spot: or none; a photometric profile (IES, EULUMDAT), factor on the emission by
    // direction; meanLuminance is that of emission x profile over all directions, of a spot over its cone.
    // Environment: the map; LightTable::uploadEnvironment says how it is drawn. Maps and profiles have a
    // sampler that repeats in u and clamps in v.
    uint32_t texture = RS_NO_TEXTURE;
    float uv[3][2] = {};
    float meanLuminance = -1;
};

// Triangle lights that LightTable makes on the device of what the scene's buffers hold: corners and texture
// coordinates of the geometry, placed by its transform, emitting as its material does. What is said of
// triangle lights above holds of them. Black triangles, those without area and those that are not finite are
// no lights.
struct LightMesh {
    uint32_t record = 0;       // in SceneDesc::instances
    uint32_t firstLight = 0;   // the record's RsInstance::firstLight: the id of primitive 0
    uint32_t triangles = 0;    // primitives of the geometry, > 0
};

// What the texture of the environment light shows, for the table that it is drawn from: the texture itself,
// or it reduced by averaging. Where it is black the texture, filtered linearly, must be. It is not kept.
struct EnvironmentMap {
    // Texels, at most 32768 each, and LightTableDesc::maxEnvironmentTexels in all.
    uint32_t width = 0, height = 0;
    std::span<const float> rgb;   // 3 floats a texel, linear, [0, 1e30]; rows from the top
};

struct LightTableDesc {
    uint32_t maxLights = 0;    // one more than the largest id, at most 2^20; 0 is allowed
    uint32_t meshLights = 0;   // ids below are of LightMeshes, all others of Lights; at most maxLights
    uint32_t maxMeshes = 0;    // LightMeshes at a time, at most 2^20
    // Also build a tree over all lights that are somewhere, in every record() with something new: it finds
    // the lights next to a surface among very many (DiSettings::treeShare). 48 bytes per id, up to a power of
    // two of them, and a sort on the device.
    bool tree = true;
    // Of an EnvironmentMap, 24 bytes each, half on the device; 0: no environment light.
    uint32_t maxEnvironmentTexels = 0;
};

// What a host's own shaders draw lights from, with shaders/restir/bridge/lights.glsl. Storage buffers.
struct LightBuffers {
    VkBuffer lights = VK_NULL_HANDLE;        // gpu::RsPackedLight[count]; one of two handles, in turns
    VkBuffer alias = VK_NULL_HANDLE;         // gpu::RsAliasEntry[]
    VkBuffer environment = VK_NULL_HANDLE;   // gpu::RsEnvironmentTexel[], row by row
    VkBuffer tree = VK_NULL_HANDLE;          // restir/lights/tree.glsl; null without LightTableDesc::tree
    uint32_t count = 0;                      // one more than the largest id; 0: there are no lights
    VkExtent2D environmentExtent = {0, 0};   // texels
};

// The lights of a scene and the table to draw them from, shared by any number of Sessions. Externally
// synchronised. Frames that read it are submitted in recording order on one queue of
// ContextDesc::queueFamily.
class LightTable {
public:
    static Result<LightTable> create(const Context& context, const LightTableDesc& desc) noexcept;
    static VkDeviceSize memoryNeeded(const Context& context, const LightTableDesc& desc) noexcept;   // bytes
    LightTable(LightTable&&) noexcept;
    LightTable& operator=(LightTable&&) noexcept;
    ~LightTable();   // the GPU is done with its last frame

    // All lights of this frame; those not named are gone. The GPU is done with the slot's last use, and after
    // a recorded command buffer that was never submitted the lights must be uploaded again. Checks the lights
    // and packs them into the slot's staging memory, in one pass; record() must follow. On an error the
    // message sink names the light and the field, and the previous lights stay.
    [[nodiscard]] Status upload(uint32_t frameSlot, std::span<const Light> lights) noexcept;
    // All meshes of this and the following frames; those not named are gone. As upload(), which it does not
    // replace: a table may have lights from both. Needed again only when this list changes, or what a texture
    // shows of a mesh (its texels, coordinates or its index in the material): the mean of the texture over
    // each triangle, by which it is chosen, is taken once.
    [[nodiscard]] Status uploadMeshes(uint32_t frameSlot, std::span<const LightMesh> meshes) noexcept;
    // The environment light's map, before the first upload that has such a light, and again when the map
    // changes (then before an upload, so that its power counts). Rotation and factor may change without. The
    // GPU is done with the last upload of a map. Builds an alias table over its texels; while it differs from
    // the last frame's, what the last frame's light would have been is read from the new texture. A map of
    // zeros is a dark sky.
    [[nodiscard]] Status uploadEnvironment(const EnvironmentMap& map) noexcept;
    // Records the copy of the last upload, of lights, meshes or map, and the passes that build the table to
    // draw lights from, by their power; call after every upload and before Session::record, outside any
    // render pass. Without a new upload it records nothing, unless there are meshes: those it reads again,
    // each time, from `scene` or `bridgeSet`, as in FrameInput, all of it available to Session::inputScope().
    // Leaves the compute bind point with the SDK's pipeline and sets.
    [[nodiscard]] Status record(VkCommandBuffer cmd, uint32_t frameSlot, const Scene* scene = nullptr,
                                VkDescriptorSet bridgeSet = VK_NULL_HANDLE) noexcept;

    // Of the last record(), for commands between that and the next one. Compute shaders may read them at
    // once, other stages behind a barrier from Session::passScope(). The next record() waits for compute
    // shaders only: before it the host makes other stages' reads an execution dependency of
    // passScope().stages.
    LightBuffers buffers() const noexcept;

    // As Session::timings(), of the last build recorded in `frameSlot`.
    std::span<const PassTiming> timings(uint32_t frameSlot) noexcept;

    struct Impl;

private:
    friend struct Internals;
    explicit LightTable(std::unique_ptr<Impl> impl) noexcept;
    std::unique_ptr<Impl> impl_;
};

}   // namespace restir
