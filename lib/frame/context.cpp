#include <algorithm>
#include <cstring>
#include <utility>

#include <frame/context_impl.h>
#include <frame/layouts.h>
#include <restir_embedded.h>

namespace restir {
namespace {

const ShaderPack& embeddedPack(RayBackend rays) noexcept {
    if (rays == RayBackend::Pipeline) return kEmbeddedPipelinePack;
    return rays == RayBackend::Software ? kEmbeddedSoftwarePack : kEmbeddedQueryPack;
}

Result<bool> makePipelines(Context::Impl& c, const ShaderPack& pack, PipelineCreation when) noexcept {
    const MessageSink& sink = c.device.sink();
    if (pack.shaderAbi != RESTIR_SHADER_ABI) {
        report(sink, Severity::Error, "restir: ContextDesc::shaders has ABI %u, this library %d", pack.shaderAbi,
               RESTIR_SHADER_ABI);
        return Error{Status::ShaderMismatch, VK_SUCCESS, "ContextDesc::shaders was built against another ABI"};
    }
    if (pack.rays != c.rays) {
        report(sink, Severity::Error, "restir: ContextDesc::shaders trace with RayBackend %d, ContextDesc::rays is %d",
               int(pack.rays), int(c.rays));
        return Error{Status::ShaderMismatch, VK_SUCCESS, "ContextDesc::shaders was built for another ray backend"};
    }
    return c.pipelines.create(c.device, {c.pipelineLayout, c.tablePipelineLayout}, pack, when);
}

Status checkDesc(const ContextDesc& desc) noexcept {
    const MessageSink& sink = desc.device.messages;
    if (!desc.device.getInstanceProcAddr) return refuse(sink, "restir: DeviceInfo::getInstanceProcAddr is null");
    if (!desc.device.instance) return refuse(sink, "restir: DeviceInfo::instance is null");
    if (!desc.device.physicalDevice) return refuse(sink, "restir: DeviceInfo::physicalDevice is null");
    if (!desc.device.device) return refuse(sink, "restir: DeviceInfo::device is null");
    if ((desc.device.memory.acquire == nullptr) != (desc.device.memory.release == nullptr))
        return refuse(sink, "restir: DeviceInfo::memory needs both acquire and release, or neither");
    if (desc.framesInFlight < 1 || desc.framesInFlight > 16)
        return refuse(sink, "restir: ContextDesc::framesInFlight is %u, must be in [1, 16]", desc.framesInFlight);
    if (desc.pipelines > PipelineCreation::OnDemand)
        return refuse(sink, "restir: ContextDesc::pipelines is %d", int(desc.pipelines));
    if (desc.rays > RayBackend::Own) return refuse(sink, "restir: ContextDesc::rays is %d", int(desc.rays));
    if (desc.rays == RayBackend::Own && !desc.shaders)
        return refuse(sink, "restir: ContextDesc::shaders is null, RayBackend::Own needs one");
    if (desc.maxTextures < 1) return refuse(sink, "restir: ContextDesc::maxTextures is 0");
    return Status::Ok;
}

Status queryDevice(Device& device, RayBackend rays, uint32_t queueFamily) noexcept {
    if (const char* missing = loadInstanceFunctions(device.info, device.functions)) {
        report(device.sink(), Severity::Error, "restir: the loader lacks %s", missing);
        return Status::MissingFeature;
    }
    if (const char* missing = loadDeviceFunctions(device.info, rays, device.functions)) {
        report(device.sink(), Severity::Error, "restir: the device lacks %s", missing);
        return Status::MissingFeature;
    }
    const Functions& f = device.functions;
    f.vkGetPhysicalDeviceMemoryProperties(device.info.physicalDevice, &device.memory);
    VkPhysicalDeviceProperties2 properties{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2};
    f.vkGetPhysicalDeviceProperties2(device.info.physicalDevice, &properties);
    device.limits = properties.properties.limits;

    VkQueueFamilyProperties families[64];
    uint32_t count = 64;
    f.vkGetPhysicalDeviceQueueFamilyProperties(device.info.physicalDevice, &count, families);
    if (queueFamily >= count)
        return refuse(device.sink(), "restir: ContextDesc::queueFamily is %u, the device has %u", queueFamily, count);
    if (!(families[queueFamily].queueFlags & VK_QUEUE_COMPUTE_BIT))
        return refuse(device.sink(), "restir: ContextDesc::queueFamily %u has no compute", queueFamily);
    device.timestampBits = families[queueFamily].timestampValidBits;
    return Status::Ok;
}

Status checkLimits(const Context::Impl& c, const ContextDesc& desc) noexcept {
    const VkPhysicalDeviceLimits& limits = c.device.limits;
    const uint32_t textures = desc.bridgeSetLayout ? 0 : desc.maxTextures;
    uint32_t storage = 2, sampled = textures, images = 0;   // the scene set's
    for (uint32_t i = 0; i < RS_BIND_COUNT; ++i) {
        if (!isBound(i, c.rays)) continue;
        if (bindingType(i) == VK_DESCRIPTOR_TYPE_STORAGE_BUFFER) storage += bindingCount(i);
        if (bindingType(i) == VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE) ++sampled;
        if (bindingType(i) == VK_DESCRIPTOR_TYPE_STORAGE_IMAGE) ++images;
    }
    const MessageSink& sink = c.device.sink();
    if (sampled > limits.maxPerStageDescriptorSampledImages || textures > limits.maxPerStageDescriptorSamplers)
        return refuse(sink, "restir: ContextDesc::maxTextures is %u, this device has %u sampled images and %u samplers a stage",
                      desc.maxTextures, limits.maxPerStageDescriptorSampledImages, limits.maxPerStageDescriptorSamplers);
    if (storage > limits.maxPerStageDescriptorStorageBuffers)
        return refuse(sink, "restir: the passes bind %u storage buffers, this device has %u a stage", storage,
                      limits.maxPerStageDescriptorStorageBuffers);
    if (images > limits.maxPerStageDescriptorStorageImages)
        return refuse(sink, "restir: the passes bind %u storage images, this device has %u a stage", images,
                      limits.maxPerStageDescriptorStorageImages);
    return Status::Ok;
}

}   // namespace

Context::Context(std::unique_ptr<Impl> impl) noexcept : impl_(std::move(impl)) {}
Context::Context(Context&&) noexcept = default;
Context& Context::operator=(Context&&) noexcept = default;
Context::~Context() = default;

Result<Context> Context::create(const ContextDesc& desc) noexcept {
    if (Status s = checkDesc(desc); s != Status::Ok) return Error{s, VK_SUCCESS, "ContextDesc is invalid"};
    auto impl = std::make_unique<Impl>();
    impl->device.info = desc.device;
    impl->rays = desc.rays;
    impl->device.passStages = passStages(desc.rays);
    impl->framesInFlight = desc.framesInFlight;
    impl->maxTextures = desc.maxTextures;
    if (Status s = queryDevice(impl->device, desc.rays, desc.queueFamily); s != Status::Ok)
        return Error{s, VK_SUCCESS, "the device cannot be used"};
    if (Status s = checkLimits(*impl, desc); s != Status::Ok) return Error{s, VK_SUCCESS, "the device's limits are too low"};
    if (auto made = makeLayouts(*impl, desc.bridgeSetLayout); !made) return made.error();
    const ShaderPack& pack = desc.shaders ? *desc.shaders : embeddedPack(desc.rays);
    if (auto made = makePipelines(*impl, pack, desc.pipelines); !made) return made.error();
    return Context(std::move(impl));
}

Context::Impl::~Impl() {
    const Functions& f = device.functions;
    const VkDevice vk = device.info.device;
    if (pipelineLayout) f.vkDestroyPipelineLayout(vk, pipelineLayout, device.allocator());
    if (tablePipelineLayout) f.vkDestroyPipelineLayout(vk, tablePipelineLayout, device.allocator());
    if (tableLayout) f.vkDestroyDescriptorSetLayout(vk, tableLayout, device.allocator());
    if (frameLayout) f.vkDestroyDescriptorSetLayout(vk, frameLayout, device.allocator());
    if (sceneLayout && ownsSceneLayout) f.vkDestroyDescriptorSetLayout(vk, sceneLayout, device.allocator());
}

}   // namespace restir
