// A whole host in one file: a device without a window, a scene, its acceleration structure, a G-buffer,
// frames in flight and a picture. What restir asks of it is the example below and the few lines elsewhere
// that call it; the rest is what an engine already has.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include <vulkan/vulkan.h>

#include <restir/restir.h>

namespace {

constexpr uint32_t kSlots = 2, kFrames = 12;
constexpr VkExtent2D kExtent{480, 270};
constexpr VkFormat kFormat = VK_FORMAT_R32G32B32A32_SFLOAT;   // of every image
constexpr VkDeviceSize kImageBytes = VkDeviceSize{16} * kExtent.width * kExtent.height;

struct Vec3 {
    float x, y, z;
};
Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Vec3 operator*(float s, Vec3 a) { return {s * a.x, s * a.y, s * a.z}; }
float dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vec3 cross(Vec3 a, Vec3 b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
Vec3 unit(Vec3 a) { return 1 / std::sqrt(dot(a, a)) * a; }

struct Matrix {
    float m[16];   // column-major
};

struct Engine {
    PFN_vkGetInstanceProcAddr getInstanceProcAddr = vkGetInstanceProcAddr;
    VkInstance instance = VK_NULL_HANDLE;
    VkPhysicalDevice physicalDevice = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
    uint32_t queueFamily = 0;
    VkQueue queue = VK_NULL_HANDLE;
    VkCommandPool pool = VK_NULL_HANDLE;
    VkBuffer instances = VK_NULL_HANDLE, materials = VK_NULL_HANDLE;
    std::vector<VkDescriptorImageInfo> textures;
    std::vector<std::function<void()>> cleanup;   // run backwards

    ~Engine() {
        for (; !cleanup.empty(); cleanup.pop_back()) cleanup.back()();
    }
};

struct View {
    VkExtent2D extent = kExtent;
    uint32_t slot = 0;
    uint64_t frame = 0;
    bool cut = false;
    Matrix viewFromWorld{}, clipFromView{};
    VkImageView depth = VK_NULL_HANDLE, normal = VK_NULL_HANDLE, albedo = VK_NULL_HANDLE,
                emission = VK_NULL_HANDLE;
    VkImageView material = VK_NULL_HANDLE, motion = VK_NULL_HANDLE;   // this engine has neither
    VkImageView lit = VK_NULL_HANDLE;
    VkAccelerationStructureKHR tlas = VK_NULL_HANDLE, previousTlas = VK_NULL_HANDLE;
    std::vector<restir::Light> lights;
    restir::Scope reader;   // whoever shows the picture
};

[[noreturn]] void stop(const char* what) {
    std::fprintf(stderr, "minimal: %s\n", what);
    std::exit(1);
}
void check(VkResult result, const char* what) {
    if (result != VK_SUCCESS) stop(what);
}

void print(void*, restir::Severity, const char* text) { std::fprintf(stderr, "%s\n", text); }
std::nullopt_t fail(const restir::Error& error) {
    std::fprintf(stderr, "%s\n", error.what);
    return std::nullopt;
}

void barrier(VkCommandBuffer cmd, restir::Scope from, restir::Scope to) {
    const VkMemoryBarrier2 memory{.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2,
                                  .srcStageMask = from.stages,
                                  .srcAccessMask = from.access,
                                  .dstStageMask = to.stages,
                                  .dstAccessMask = to.access};
    const VkDependencyInfo info{
        .sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO, .memoryBarrierCount = 1, .pMemoryBarriers = &memory};
    vkCmdPipelineBarrier2(cmd, &info);
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
    auto session = restir::Session::create(
        *context, {.maxExtent = maxExtent, .pairedNeighbours = restir::kPresetPartners});
    if (!session) return fail(session.error());
    return Lighting{std::move(*context), std::move(*scene), std::move(*lights), std::move(*session)};
}

// After the G-buffer and its barrier to Session::inputScope(), before whoever reads the picture.
bool drawLighting(Lighting& lighting, VkCommandBuffer cmd, const View& view) {
    // Only needed when they change.
    if (lighting.lights.upload(view.slot, view.lights) != restir::Status::Ok) return false;
    if (lighting.lights.record(cmd, view.slot) != restir::Status::Ok) return false;

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
    if (lighting.session.record(cmd, frame, settings) != restir::Status::Ok) return false;

    barrier(cmd, restir::Session::outputScope(), view.reader);
    return true;
}
// END EXAMPLE

// ---- device ---------------------------------------------------------------------------------

void makeInstance(Engine& engine) {
    const VkApplicationInfo application{.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO,
                                        .pApplicationName = "minimal",
                                        .apiVersion = VK_API_VERSION_1_3};
    const VkInstanceCreateInfo info{.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
                                    .pApplicationInfo = &application};
    check(vkCreateInstance(&info, nullptr, &engine.instance), "vkCreateInstance failed");
    engine.cleanup.push_back([&engine] { vkDestroyInstance(engine.instance, nullptr); });

    uint32_t count = 0;
    vkEnumeratePhysicalDevices(engine.instance, &count, nullptr);
    std::vector<VkPhysicalDevice> all(count);
    check(vkEnumeratePhysicalDevices(engine.instance, &count, all.data()),
          "vkEnumeratePhysicalDevices failed");
    for (VkPhysicalDevice candidate : all) {
        const restir::DeviceInfo device{vkGetInstanceProcAddr, engine.instance, candidate};
        if (restir::checkDevice(device, restir::RayBackend::RayQuery) != restir::Status::Ok) continue;
        engine.physicalDevice = candidate;
        return;
    }
    stop("no device that restir can use");
}

void makeDevice(Engine& engine) {
    uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(engine.physicalDevice, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(engine.physicalDevice, &count, families.data());
    while (!(families[engine.queueFamily].queueFlags & VK_QUEUE_COMPUTE_BIT)) ++engine.queueFamily;

    restir::DeviceNeeds needs = restir::deviceNeeds(restir::RayBackend::RayQuery);
    const float priority = 1;
    const VkDeviceQueueCreateInfo queue{.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                                        .queueFamilyIndex = engine.queueFamily,
                                        .queueCount = 1,
                                        .pQueuePriorities = &priority};
    const VkDeviceCreateInfo info{.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                                  .pNext = needs.chain(),
                                  .queueCreateInfoCount = 1,
                                  .pQueueCreateInfos = &queue,
                                  .enabledExtensionCount = uint32_t(needs.extensions.size()),
                                  .ppEnabledExtensionNames = needs.extensions.data()};
    check(vkCreateDevice(engine.physicalDevice, &info, nullptr, &engine.device), "vkCreateDevice failed");
    engine.cleanup.push_back([&engine] { vkDestroyDevice(engine.device, nullptr); });
    vkGetDeviceQueue(engine.device, engine.queueFamily, 0, &engine.queue);

    const VkCommandPoolCreateInfo pool{.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                       .flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT,
                                       .queueFamilyIndex = engine.queueFamily};
    check(vkCreateCommandPool(engine.device, &pool, nullptr, &engine.pool), "vkCreateCommandPool failed");
    engine.cleanup.push_back([&engine] { vkDestroyCommandPool(engine.device, engine.pool, nullptr); });
}

VkDeviceMemory allocate(Engine& engine, const VkMemoryRequirements& need, VkMemoryPropertyFlags wanted) {
    VkPhysicalDeviceMemoryProperties memory;
    vkGetPhysicalDeviceMemoryProperties(engine.physicalDevice, &memory);
    uint32_t type = 0;
    while (!(need.memoryTypeBits >> type & 1) || (memory.memoryTypes[type].propertyFlags & wanted) != wanted)
        if (++type == memory.memoryTypeCount) stop("no memory of a kind that is needed");
    const VkMemoryAllocateFlagsInfo flags{.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO,
                                          .flags = VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT};
    const VkMemoryAllocateInfo info{.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
                                    .pNext = &flags,
                                    .allocationSize = need.size,
                                    .memoryTypeIndex = type};
    VkDeviceMemory result = VK_NULL_HANDLE;
    check(vkAllocateMemory(engine.device, &info, nullptr, &result), "vkAllocateMemory failed");
    engine.cleanup.push_back([&engine, result] { vkFreeMemory(engine.device, result, nullptr); });
    return result;
}

struct Buffer {
    VkBuffer buffer = VK_NULL_HANDLE;
    VkDeviceAddress address = 0;
    void* mapped = nullptr;
};

// All in host memory: this engine has nothing to hide from the CPU.
Buffer makeBuffer(Engine& engine, VkDeviceSize size, VkBufferUsageFlags usage,
                  const void* contents = nullptr) {
    Buffer result;
    const VkBufferCreateInfo info{.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
                                  .size = size,
                                  .usage = usage | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT};
    check(vkCreateBuffer(engine.device, &info, nullptr, &result.buffer), "vkCreateBuffer failed");
    VkMemoryRequirements need;
    vkGetBufferMemoryRequirements(engine.device, result.buffer, &need);
    const VkDeviceMemory memory =
        allocate(engine, need, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
    check(vkBindBufferMemory(engine.device, result.buffer, memory, 0), "vkBindBufferMemory failed");
    check(vkMapMemory(engine.device, memory, 0, VK_WHOLE_SIZE, 0, &result.mapped), "vkMapMemory failed");
    if (contents) std::memcpy(result.mapped, contents, size);
    const VkBufferDeviceAddressInfo address{.sType = VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO,
                                            .buffer = result.buffer};
    result.address = vkGetBufferDeviceAddress(engine.device, &address);
    engine.cleanup.push_back([&engine, b = result.buffer] { vkDestroyBuffer(engine.device, b, nullptr); });
    return result;
}

struct Image {
    VkImage image = VK_NULL_HANDLE;
    VkImageView view = VK_NULL_HANDLE;
};

Image makeImage(Engine& engine, VkImageUsageFlags usage) {
    Image result;
    const VkImageCreateInfo info{.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
                                 .imageType = VK_IMAGE_TYPE_2D,
                                 .format = kFormat,
                                 .extent = {kExtent.width, kExtent.height, 1},
                                 .mipLevels = 1,
                                 .arrayLayers = 1,
                                 .samples = VK_SAMPLE_COUNT_1_BIT,
                                 .usage = usage};
    check(vkCreateImage(engine.device, &info, nullptr, &result.image), "vkCreateImage failed");
    VkMemoryRequirements need;
    vkGetImageMemoryRequirements(engine.device, result.image, &need);
    const VkDeviceMemory memory = allocate(engine, need, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    check(vkBindImageMemory(engine.device, result.image, memory, 0), "vkBindImageMemory failed");
    const VkImageViewCreateInfo view{.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
                                     .image = result.image,
                                     .viewType = VK_IMAGE_VIEW_TYPE_2D,
                                     .format = kFormat,
                                     .subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1}};
    check(vkCreateImageView(engine.device, &view, nullptr, &result.view), "vkCreateImageView failed");
    engine.cleanup.push_back([&engine, result] {
        vkDestroyImageView(engine.device, result.view, nullptr);
        vkDestroyImage(engine.device, result.image, nullptr);
    });
    return result;
}

void transition(VkCommandBuffer cmd, VkImage image, VkImageLayout from, VkImageLayout to,
                restir::Scope before, restir::Scope after) {
    const VkImageMemoryBarrier2 memory{.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2,
                                       .srcStageMask = before.stages,
                                       .srcAccessMask = before.access,
                                       .dstStageMask = after.stages,
                                       .dstAccessMask = after.access,
                                       .oldLayout = from,
                                       .newLayout = to,
                                       .image = image,
                                       .subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1}};
    const VkDependencyInfo info{.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
                                .imageMemoryBarrierCount = 1,
                                .pImageMemoryBarriers = &memory};
    vkCmdPipelineBarrier2(cmd, &info);
}

// ---- scene ----------------------------------------------------------------------------------

struct Triangle {
    Vec3 corner[3];
    Vec3 color;   // of lamps: radiance
};

// Lamps are a geometry of their own: triangle i of it is light i.
struct World {
    std::vector<Triangle> solids, lamps;
};

void addQuad(std::vector<Triangle>& triangles, Vec3 corner, Vec3 u, Vec3 v, Vec3 color) {
    triangles.push_back({{corner, corner + u, corner + u + v}, color});
    triangles.push_back({{corner, corner + u + v, corner + v}, color});
}

void addBox(std::vector<Triangle>& triangles, Vec3 low, Vec3 size, Vec3 color) {
    const Vec3 x{size.x, 0, 0}, y{0, size.y, 0}, z{0, 0, size.z};
    addQuad(triangles, low, x, y, color);
    addQuad(triangles, low + z, x, y, color);
    addQuad(triangles, low, z, y, color);
    addQuad(triangles, low + x, z, y, color);
    addQuad(triangles, low + y, x, z, color);
}

// A courtyard with pillars under strings of coloured lamps that face down.
World makeWorld() {
    World world;
    addQuad(world.solids, {-6, 0, -6}, {12, 0, 0}, {0, 0, 12}, {0.6f, 0.58f, 0.55f});
    addQuad(world.solids, {-6, 0, -4}, {12, 0, 0}, {0, 5, 0}, {0.7f, 0.7f, 0.72f});
    for (int i = 0; i < 6; ++i) {
        const float height = 0.6f + 0.35f * float(i % 3);
        addBox(world.solids, {-3.2f + 1.2f * float(i), 0, -1.8f + 0.8f * float(i % 2)},
               {0.45f, height, 0.45f}, {0.8f, 0.45f + 0.06f * float(i), 0.35f});
    }
    for (int row = 0; row < 4; ++row) {
        for (int i = 0; i < 16; ++i) {
            const float hue = 0.4f * float(i + 5 * row);
            const Vec3 color{1 + std::cos(hue), 1 + std::cos(hue - 2.1f), 1 + std::cos(hue - 4.2f)};
            addQuad(
                world.lamps,
                {-3.75f + 0.5f * float(i), 2.4f + 0.3f * std::cos(0.4f * float(i - 8)), -2.5f + float(row)},
                {0.06f, 0, 0}, {0, 0, 0.06f}, 150.0f * color);
        }
    }
    return world;
}

// A slow pulse, so that the lights have a reason to be uploaded in every frame.
float brightness(size_t lamp, uint64_t frame) {
    return 1 + 0.5f * std::sin(0.15f * float(frame) + float(lamp / 2));
}

std::vector<restir::Light> makeLights(const World& world, uint64_t frame) {
    std::vector<restir::Light> lights(world.lamps.size());
    for (size_t i = 0; i < lights.size(); ++i) {
        const Vec3 emission = brightness(i, frame) * world.lamps[i].color;
        lights[i].id = uint32_t(i);
        std::memcpy(lights[i].position, &world.lamps[i].corner[0], sizeof(Vec3));
        std::memcpy(lights[i].vertex1, &world.lamps[i].corner[1], sizeof(Vec3));
        std::memcpy(lights[i].vertex2, &world.lamps[i].corner[2], sizeof(Vec3));
        std::memcpy(lights[i].emission, &emission, sizeof(Vec3));
    }
    return lights;
}

// ---- acceleration structure -----------------------------------------------------------------

struct RayFunctions {
    PFN_vkGetAccelerationStructureBuildSizesKHR sizes;
    PFN_vkCreateAccelerationStructureKHR create;
    PFN_vkDestroyAccelerationStructureKHR destroy;
    PFN_vkGetAccelerationStructureDeviceAddressKHR address;
    PFN_vkCmdBuildAccelerationStructuresKHR build;

    explicit RayFunctions(VkDevice device) {
        const auto load = [device](const char* name) { return vkGetDeviceProcAddr(device, name); };
        sizes = reinterpret_cast<decltype(sizes)>(load("vkGetAccelerationStructureBuildSizesKHR"));
        create = reinterpret_cast<decltype(create)>(load("vkCreateAccelerationStructureKHR"));
        destroy = reinterpret_cast<decltype(destroy)>(load("vkDestroyAccelerationStructureKHR"));
        address = reinterpret_cast<decltype(address)>(load("vkGetAccelerationStructureDeviceAddressKHR"));
        build = reinterpret_cast<decltype(build)>(load("vkCmdBuildAccelerationStructuresKHR"));
    }
};

constexpr restir::Scope kBuilt{
    VK_PIPELINE_STAGE_2_ACCELERATION_STRUCTURE_BUILD_BIT_KHR,
    VK_ACCESS_2_ACCELERATION_STRUCTURE_WRITE_BIT_KHR | VK_ACCESS_2_ACCELERATION_STRUCTURE_READ_BIT_KHR};

VkAccelerationStructureKHR build(Engine& engine, VkCommandBuffer cmd, VkAccelerationStructureTypeKHR type,
                                 const std::vector<VkAccelerationStructureGeometryKHR>& geometries,
                                 const std::vector<uint32_t>& counts) {
    const RayFunctions rays(engine.device);
    VkAccelerationStructureBuildGeometryInfoKHR info{
        .sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_GEOMETRY_INFO_KHR,
        .type = type,
        .flags = VK_BUILD_ACCELERATION_STRUCTURE_PREFER_FAST_TRACE_BIT_KHR,
        .geometryCount = uint32_t(geometries.size()),
        .pGeometries = geometries.data()};
    VkAccelerationStructureBuildSizesInfoKHR sizes{
        .sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_SIZES_INFO_KHR};
    rays.sizes(engine.device, VK_ACCELERATION_STRUCTURE_BUILD_TYPE_DEVICE_KHR, &info, counts.data(), &sizes);
    const VkDeviceSize alignment = 256;   // no device asks for more
    const Buffer storage = makeBuffer(engine, sizes.accelerationStructureSize,
                                      VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_STORAGE_BIT_KHR);
    const Buffer scratch =
        makeBuffer(engine, sizes.buildScratchSize + alignment, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);

    const VkAccelerationStructureCreateInfoKHR create{
        .sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_CREATE_INFO_KHR,
        .buffer = storage.buffer,
        .size = sizes.accelerationStructureSize,
        .type = type};
    check(rays.create(engine.device, &create, nullptr, &info.dstAccelerationStructure),
          "vkCreateAccelerationStructureKHR failed");
    engine.cleanup.push_back(
        [&engine, rays, s = info.dstAccelerationStructure] { rays.destroy(engine.device, s, nullptr); });
    info.scratchData.deviceAddress = (scratch.address + alignment - 1) / alignment * alignment;
    std::vector<VkAccelerationStructureBuildRangeInfoKHR> ranges;
    for (uint32_t count : counts) ranges.push_back({.primitiveCount = count});
    const VkAccelerationStructureBuildRangeInfoKHR* pointer = ranges.data();
    rays.build(cmd, 1, &info, &pointer);
    return info.dstAccelerationStructure;
}

VkAccelerationStructureGeometryKHR trianglesOf(const restir::gpu::RsInstance& record, size_t triangles) {
    VkAccelerationStructureGeometryKHR geometry{
        .sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR,
        .geometryType = VK_GEOMETRY_TYPE_TRIANGLES_KHR,
        .geometry = {},
        .flags = VK_GEOMETRY_OPAQUE_BIT_KHR};
    geometry.geometry.triangles = {
        .sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_TRIANGLES_DATA_KHR,
        .vertexFormat = VK_FORMAT_R32G32B32_SFLOAT,
        .vertexData = {.deviceAddress = record.positions},
        .vertexStride = sizeof(Vec3),
        .maxVertex = uint32_t(3 * triangles - 1),
        .indexType = VK_INDEX_TYPE_UINT32,
        .indexData = {.deviceAddress = record.indices}};
    return geometry;
}

// Vertices, what restir is told of them, and both levels of the acceleration structure.
VkAccelerationStructureKHR makeScene(Engine& engine, VkCommandBuffer cmd, const World& world) {
    using namespace restir;
    const VkBufferUsageFlags input = VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_BUILD_INPUT_READ_ONLY_BIT_KHR;
    std::vector<Vec3> positions;
    for (const auto* triangles : {&world.solids, &world.lamps})
        for (const Triangle& t : *triangles) positions.insert(positions.end(), t.corner, t.corner + 3);
    std::vector<uint32_t> indices(positions.size());
    for (uint32_t i = 0; i < indices.size(); ++i) indices[i] = i;
    const Buffer vertexBuffer = makeBuffer(engine, positions.size() * sizeof(Vec3), input, positions.data());
    const Buffer indexBuffer = makeBuffer(engine, indices.size() * sizeof(uint32_t), input, indices.data());

    gpu::RsInstance records[2]{};   // solids, lamps
    for (auto& record : records) {
        record.positions = vertexBuffer.address;
        record.indices = indexBuffer.address;
        record.worldFromObject[0] = {1, 0, 0, 0};
        record.worldFromObject[1] = {0, 1, 0, 0};
        record.worldFromObject[2] = {0, 0, 1, 0};
        record.firstLight = RS_NO_LIGHT;
    }
    records[1].positions += world.solids.size() * sizeof world.solids[0].corner;
    records[1].firstLight = 0;
    const gpu::RsMaterial material{.baseColor = {0.5f, 0.5f, 0.5f, 1},
                                   .roughness = 1,
                                   .specular = 1,
                                   .baseColorTexture = RS_NO_TEXTURE,
                                   .metallicRoughnessTexture = RS_NO_TEXTURE,
                                   .normalTexture = RS_NO_TEXTURE,
                                   .emissionTexture = RS_NO_TEXTURE};
    engine.instances = makeBuffer(engine, sizeof records, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, records).buffer;
    engine.materials =
        makeBuffer(engine, sizeof material, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, &material).buffer;

    const VkAccelerationStructureKHR mesh =
        build(engine, cmd, VK_ACCELERATION_STRUCTURE_TYPE_BOTTOM_LEVEL_KHR,
              {trianglesOf(records[0], world.solids.size()), trianglesOf(records[1], world.lamps.size())},
              {uint32_t(world.solids.size()), uint32_t(world.lamps.size())});
    barrier(cmd, kBuilt, kBuilt);
    const VkAccelerationStructureDeviceAddressInfoKHR address{
        .sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_DEVICE_ADDRESS_INFO_KHR,
        .accelerationStructure = mesh};
    const VkAccelerationStructureInstanceKHR instance{
        .transform = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}},
        .mask = 0xff,
        .accelerationStructureReference = RayFunctions(engine.device).address(engine.device, &address)};
    VkAccelerationStructureGeometryKHR geometry{
        .sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR,
        .geometryType = VK_GEOMETRY_TYPE_INSTANCES_KHR};
    geometry.geometry.instances = {
        .sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_INSTANCES_DATA_KHR,
        .data = {.deviceAddress = makeBuffer(engine, sizeof instance, input, &instance).address}};
    const VkAccelerationStructureKHR top =
        build(engine, cmd, VK_ACCELERATION_STRUCTURE_TYPE_TOP_LEVEL_KHR, {geometry}, {1});
    barrier(cmd, kBuilt, Session::inputScope());
    return top;
}

// ---- G-buffer -------------------------------------------------------------------------------

struct Camera {
    Vec3 eye, right, up, forward;   // the axes are unit vectors
    float tanX, tanY, near;

    // View space looks down -z.
    Matrix viewFromWorld() const {
        return {{right.x, up.x, -forward.x, 0, right.y, up.y, -forward.y, 0, right.z, up.z, -forward.z, 0,
                 -dot(right, eye), -dot(up, eye), dot(forward, eye), 1}};
    }
    // Infinite far plane; y goes down in clip space.
    Matrix clipFromView() const {
        return {{1 / tanX, 0, 0, 0, 0, -1 / tanY, 0, 0, 0, 0, -1, -1, 0, 0, -near, 0}};
    }
};

Camera cameraAt(uint64_t frame) {
    const float angle = 0.4f - 0.01f * float(frame);
    Camera camera{.eye = {4.5f * std::sin(angle), 1.3f, 4.5f * std::cos(angle)},
                  .tanX = 0.45f * float(kExtent.width) / float(kExtent.height),
                  .tanY = 0.45f,
                  .near = 0.1f};
    camera.forward = unit(Vec3{0, 1.1f, -1} - camera.eye);
    camera.right = unit(cross(camera.forward, {0, 1, 0}));
    camera.up = cross(camera.right, camera.forward);
    return camera;
}

// Distance along `direction` (Moeller and Trumbore 1997), or `farthest` where there is no hit before it.
float intersect(const Triangle& t, Vec3 origin, Vec3 direction, float farthest) {
    const Vec3 e1 = t.corner[1] - t.corner[0], e2 = t.corner[2] - t.corner[0], p = cross(direction, e2);
    const float determinant = dot(e1, p);
    if (determinant == 0) return farthest;
    const Vec3 s = 1 / determinant * (origin - t.corner[0]), q = cross(s, e1);
    const float u = dot(s, p), v = dot(direction, q), distance = dot(e2, q);
    return u >= 0 && v >= 0 && u + v <= 1 && distance > 0 && distance < farthest ? distance : farthest;
}

struct Texel {
    float r = 0, g = 0, b = 0, a = 0;
};

// Octahedral, the SDK's default encoding.
Texel encodeNormal(Vec3 n) {
    n = 1 / (std::abs(n.x) + std::abs(n.y) + std::abs(n.z)) * n;
    const float x = std::copysign(1 - std::abs(n.y), n.x), y = std::copysign(1 - std::abs(n.x), n.y);
    return n.z < 0 ? Texel{x, y} : Texel{n.x, n.y};
}

constexpr size_t kGBufferImages = 4;   // depth, normal, albedo, emission

// What a rasteriser would write, by a ray through each pixel's centre: no shaders in this sample.
void drawGBuffer(const World& world, const Camera& camera, uint64_t frame, Texel* texels) {
    const size_t pixels = size_t{kExtent.width} * kExtent.height;
    for (size_t i = 0; i < pixels; ++i) {
        const float x = 2 * (float(i % kExtent.width) + 0.5f) / float(kExtent.width) - 1;
        const float y = 2 * (float(i / kExtent.width) + 0.5f) / float(kExtent.height) - 1;
        const Vec3 direction = camera.forward + x * camera.tanX * camera.right - y * camera.tanY * camera.up;
        float depth = 1e30f;   // along the view axis
        const Triangle* hit = nullptr;
        for (const auto* triangles : {&world.solids, &world.lamps})
            for (const Triangle& triangle : *triangles)
                if (const float t = intersect(triangle, camera.eye, direction, depth); t < depth)
                    depth = t, hit = &triangle;

        const bool isLamp = hit && hit >= world.lamps.data() && hit < world.lamps.data() + world.lamps.size();
        texels[i] = {hit ? (depth - camera.near) / depth : 1};
        for (size_t image = 1; image < kGBufferImages; ++image) texels[image * pixels + i] = {};
        if (!hit) continue;
        const Vec3 normal = unit(cross(hit->corner[1] - hit->corner[0], hit->corner[2] - hit->corner[0]));
        texels[pixels + i] = encodeNormal(normal);
        Vec3 color = hit->color;
        if (isLamp)
            color = (dot(normal, direction) < 0 ? brightness(size_t(hit - world.lamps.data()), frame) : 0) *
                    color;
        texels[(isLamp ? 3 : 2) * pixels + i] = {color.x, color.y, color.z, 1};
    }
}

// ---- frames ---------------------------------------------------------------------------------

constexpr restir::Scope kCopyRead{VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_READ_BIT};
constexpr restir::Scope kCopyWrite{VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT};
constexpr VkBufferImageCopy kWhole{.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                                   .imageExtent = {kExtent.width, kExtent.height, 1}};

struct Slot {
    VkCommandBuffer cmd = VK_NULL_HANDLE;
    VkFence fence = VK_NULL_HANDLE;   // signalled: the GPU is done with the slot
    Buffer staging;
};

Slot makeSlot(Engine& engine) {
    Slot slot;
    const VkCommandBufferAllocateInfo allocate{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                               .commandPool = engine.pool,
                                               .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
                                               .commandBufferCount = 1};
    check(vkAllocateCommandBuffers(engine.device, &allocate, &slot.cmd), "vkAllocateCommandBuffers failed");
    const VkFenceCreateInfo fence{.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO,
                                  .flags = VK_FENCE_CREATE_SIGNALED_BIT};
    check(vkCreateFence(engine.device, &fence, nullptr, &slot.fence), "vkCreateFence failed");
    engine.cleanup.push_back([&engine, f = slot.fence] { vkDestroyFence(engine.device, f, nullptr); });
    slot.staging = makeBuffer(engine, kGBufferImages * kImageBytes, VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
    return slot;
}

// Waits until the GPU is done with the slot's last frame.
void begin(const Engine& engine, const Slot& slot) {
    check(vkWaitForFences(engine.device, 1, &slot.fence, VK_TRUE, ~uint64_t{0}), "vkWaitForFences failed");
    check(vkResetFences(engine.device, 1, &slot.fence), "vkResetFences failed");
    const VkCommandBufferBeginInfo info{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                        .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT};
    check(vkBeginCommandBuffer(slot.cmd, &info), "vkBeginCommandBuffer failed");
}

void submit(const Engine& engine, const Slot& slot) {
    check(vkEndCommandBuffer(slot.cmd), "vkEndCommandBuffer failed");
    const VkSubmitInfo info{
        .sType = VK_STRUCTURE_TYPE_SUBMIT_INFO, .commandBufferCount = 1, .pCommandBuffers = &slot.cmd};
    check(vkQueueSubmit(engine.queue, 1, &info, slot.fence), "vkQueueSubmit failed");
}

void copyGBuffer(const Slot& slot, const Image (&images)[kGBufferImages]) {
    const restir::Scope readers = restir::Session::inputScope();
    for (size_t i = 0; i < kGBufferImages; ++i) {
        transition(slot.cmd, images[i].image, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                   {readers.stages, 0}, kCopyWrite);
        VkBufferImageCopy region = kWhole;
        region.bufferOffset = i * kImageBytes;
        vkCmdCopyBufferToImage(slot.cmd, slot.staging.buffer, images[i].image,
                               VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
        transition(slot.cmd, images[i].image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                   VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, kCopyWrite, readers);
    }
}

// Tone-mapped (Reinhard) and encoded with a gamma of 2.2.
void writePicture(const char* path, const Texel* texels) {
    std::FILE* file = std::fopen(path, "wb");
    if (!file) stop("the picture cannot be written");
    std::fprintf(file, "P6\n%u %u\n255\n", kExtent.width, kExtent.height);
    for (size_t i = 0; i < size_t{kExtent.width} * kExtent.height; ++i)
        for (float linear : {texels[i].r, texels[i].g, texels[i].b})
            std::fputc(int(255 * std::pow(linear / (1 + linear), 1 / 2.2f) + 0.5f), file);
    if (std::fclose(file) != 0) stop("the picture cannot be written");
}

}   // namespace

int main(int argc, char** argv) {
    const char* path = argc > 1 ? argv[1] : "minimal.ppm";
    Engine engine;
    makeInstance(engine);
    makeDevice(engine);
    Slot slots[kSlots];
    for (Slot& slot : slots) slot = makeSlot(engine);
    Image gbuffer[kGBufferImages];
    for (Image& image : gbuffer)
        image = makeImage(engine, VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT);
    const Image lit = makeImage(engine, VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT);
    const Buffer picture = makeBuffer(engine, kImageBytes, VK_BUFFER_USAGE_TRANSFER_DST_BIT);

    const World world = makeWorld();
    View view{.depth = gbuffer[0].view,
              .normal = gbuffer[1].view,
              .albedo = gbuffer[2].view,
              .emission = gbuffer[3].view,
              .lit = lit.view,
              .reader = kCopyRead};
    begin(engine, slots[1]);
    view.tlas = makeScene(engine, slots[1].cmd, world);
    transition(slots[1].cmd, lit.image, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_GENERAL, {},
               restir::Session::outputScope());
    submit(engine, slots[1]);

    std::optional<Lighting> lighting = makeLighting(engine, kExtent);
    if (!lighting) return 1;
    for (uint64_t frame = 0; frame < kFrames; ++frame) {
        view.slot = uint32_t(frame % kSlots);
        view.frame = frame;
        view.lights = makeLights(world, frame);
        const Camera camera = cameraAt(frame);
        view.viewFromWorld = camera.viewFromWorld();
        view.clipFromView = camera.clipFromView();
        const Slot& slot = slots[view.slot];
        begin(engine, slot);
        drawGBuffer(world, camera, frame, static_cast<Texel*>(slot.staging.mapped));
        copyGBuffer(slot, gbuffer);
        if (!drawLighting(*lighting, slot.cmd, view)) return 1;
        if (frame + 1 == kFrames) {
            vkCmdCopyImageToBuffer(slot.cmd, lit.image, VK_IMAGE_LAYOUT_GENERAL, picture.buffer, 1, &kWhole);
            barrier(slot.cmd, kCopyWrite, {VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT});
        }
        submit(engine, slot);
    }
    check(vkDeviceWaitIdle(engine.device), "vkDeviceWaitIdle failed");
    writePicture(path, static_cast<const Texel*>(picture.mapped));
    return 0;
}
