#include <cstdio>
#include <optional>
#include <utility>
#include <vector>

#include <restir/restir.h>

namespace {

// What an engine already has.
struct Engine {
    PFN_vkGetInstanceProcAddr getInstanceProcAddr;
    VkInstance instance;
    VkPhysicalDevice physicalDevice;
    VkDevice device;
    uint32_t queueFamily;
    VkBuffer instances, materials;
    std::vector<VkDescriptorImageInfo> textures;
};
struct Matrix {
    float m[16];
};
struct View {
    VkExtent2D extent;
    uint32_t slot;
    uint64_t frame;
    bool cut;
    Matrix viewFromWorld, clipFromView;
    VkImageView depth, normal, albedo, material, motion, emission, lit;
    VkAccelerationStructureKHR tlas, previousTlas;
    std::vector<restir::Light> lights;
};

void print(void*, restir::Severity, const char* text) { std::puts(text); }

std::nullopt_t fail(const restir::Error& error) {
    std::puts(error.what);
    return std::nullopt;
}

void barrier(VkCommandBuffer cmd, restir::Scope from, restir::Scope to) {
    const VkMemoryBarrier2 memory{.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2,
                                  .pNext = nullptr,
                                  .srcStageMask = from.stages,
                                  .srcAccessMask = from.access,
                                  .dstStageMask = to.stages,
                                  .dstAccessMask = to.access};
    // An engine calls vkCmdPipelineBarrier2 here.
    (void)cmd;
    (void)memory;
}

// BEGIN EXAMPLE
struct Lighting {   // in this order: each is destroyed before what it was made from
    restir::Context context;
    restir::Scene scene;
    restir::LightTable lights;
    restir::Session session;
};

std::optional<Lighting> makeLighting(const Engine& engine, VkExtent2D maxExtent) {
    auto context = restir::Context::create({.device = {.getInstanceProcAddr = engine.getInstanceProcAddr,
                                                       .instance = engine.instance,
                                                       .physicalDevice = engine.physicalDevice,
                                                       .device = engine.device,
                                                       .messages = {.report = print}},
                                            .framesInFlight = 2,
                                            .queueFamily = engine.queueFamily});
    if (!context) return fail(context.error());
    auto scene = restir::Scene::create(*context, {.instances = engine.instances,   // gpu::RsInstance[]
                                                  .materials = engine.materials,   // gpu::RsMaterial[]
                                                  .textures = engine.textures});
    if (!scene) return fail(scene.error());
    auto lights = restir::LightTable::create(*context, {.maxLights = 100'000});
    if (!lights) return fail(lights.error());
    auto session = restir::Session::create(*context, {.maxExtent = maxExtent, .pairedNeighbours = restir::kPresetPartners});
    if (!session) return fail(session.error());
    return Lighting{std::move(*context), std::move(*scene), std::move(*lights), std::move(*session)};
}

// After the G-buffer and its barrier to Session::inputScope(), before tone mapping.
bool drawLighting(Lighting& lighting, VkCommandBuffer cmd, const View& view) {
    using restir::Status;
    // Only needed when they change.
    if (lighting.lights.upload(view.slot, view.lights) != Status::Ok) return false;
    if (lighting.lights.record(cmd, view.slot) != Status::Ok) return false;

    const restir::FrameInput frame{
        .frameSlot = view.slot,
        .frameIndex = view.frame,
        .extent = view.extent,
        .camera = {.viewFromWorld = restir::Mat4::from(view.viewFromWorld),
                   .clipFromView = restir::Mat4::from(view.clipFromView)},
        .gbuffer = {.depth = {view.depth},
                    .normal = {view.normal},
                    .baseColor = {view.albedo},
                    .material = {view.material},
                    .motion = {view.motion},
                    .emission = {view.emission}},
        .tlas = view.tlas,
        .previousTlas = view.previousTlas,   // last frame's; null where nothing moves
        .scene = &lighting.scene,
        .lights = &lighting.lights,
        .output = {.radiance = view.lit},
        .resetHistory = view.cut};
    const restir::Settings settings{.di = restir::presetSettings(restir::Preset::Balanced)};
    if (lighting.session.record(cmd, frame, settings) != Status::Ok) return false;

    barrier(cmd, restir::Session::outputScope(),
            {VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT});
    return true;
}
// END EXAMPLE

}   // namespace

int main() {
    const Engine nothing{};
    auto lighting = makeLighting(nothing, {1920, 1080});   // says which field is missing
    if (lighting) return drawLighting(*lighting, VK_NULL_HANDLE, View{}) ? 2 : 1;
    return 0;
}
