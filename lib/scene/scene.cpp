#include <scene/scene_impl.h>

#include <device/internals.h>
#include <frame/context_impl.h>

namespace restir {
namespace {

Status checkDesc(const Context::Impl& context, const SceneDesc& desc) noexcept {
    const MessageSink& sink = context.device.sink();
    if (!context.ownsSceneLayout)
        return refuse(sink, "restir: Scene is the standard scene set, this Context has ContextDesc::bridgeSetLayout");
    if (!desc.instances) return refuse(sink, "restir: SceneDesc::instances is null");
    if (!desc.materials) return refuse(sink, "restir: SceneDesc::materials is null");
    if (desc.textures.size() > context.maxTextures)
        return refuse(sink, "restir: SceneDesc::textures has %zu entries, ContextDesc::maxTextures is %u",
                      desc.textures.size(), context.maxTextures);
    for (size_t i = 0; i < desc.textures.size(); ++i)
        if (!desc.textures[i].imageView || !desc.textures[i].sampler)
            return refuse(sink, "restir: SceneDesc::textures[%zu] has no view or no sampler", i);
    return Status::Ok;
}

void writeSet(const Device& device, VkDescriptorSet set, const SceneDesc& desc) noexcept {
    const VkDescriptorBufferInfo buffers[] = {{desc.instances, 0, VK_WHOLE_SIZE}, {desc.materials, 0, VK_WHOLE_SIZE}};
    VkWriteDescriptorSet writes[3];
    for (uint32_t i = 0; i < 2; ++i)
        writes[i] = {.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                     .dstSet = set,
                     .dstBinding = i == 0 ? uint32_t(RS_SCENE_BIND_INSTANCES) : uint32_t(RS_SCENE_BIND_MATERIALS),
                     .descriptorCount = 1,
                     .descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                     .pBufferInfo = &buffers[i]};
    writes[2] = {.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                 .dstSet = set,
                 .dstBinding = RS_SCENE_BIND_TEXTURES,
                 .descriptorCount = uint32_t(desc.textures.size()),
                 .descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
                 .pImageInfo = desc.textures.data()};
    device.functions.vkUpdateDescriptorSets(device.info.device, desc.textures.empty() ? 2 : 3, writes, 0, nullptr);
}

VkResult allocateSet(const Context::Impl& context, VkDescriptorPool& pool, VkDescriptorSet& set) noexcept {
    const Device& device = context.device;
    const VkDescriptorPoolSize sizes[] = {{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 2},
                                          {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, context.maxTextures}};
    const VkDescriptorPoolCreateInfo poolInfo{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                                              .maxSets = 1,
                                              .poolSizeCount = 2,
                                              .pPoolSizes = sizes};
    const VkResult vk = orNull(
        device.functions.vkCreateDescriptorPool(device.info.device, &poolInfo, device.allocator(), &pool), pool);
    if (vk != VK_SUCCESS) return vk;
    const VkDescriptorSetAllocateInfo info{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
                                           .descriptorPool = pool,
                                           .descriptorSetCount = 1,
                                           .pSetLayouts = &context.sceneLayout};
    return device.functions.vkAllocateDescriptorSets(device.info.device, &info, &set);
}

}   // namespace

Scene::Scene(std::unique_ptr<Impl> impl) noexcept : impl_(std::move(impl)) {}
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(Scene&&) noexcept = default;
Scene::~Scene() = default;

Result<Scene> Scene::create(const Context& context, const SceneDesc& desc) noexcept {
    const Context::Impl& c = Internals::of(context);
    if (Status s = checkDesc(c, desc); s != Status::Ok) return Error{s, VK_SUCCESS, "SceneDesc is invalid"};
    auto impl = std::make_unique<Impl>();
    impl->context = &c;
    impl->device = &c.device;
    impl->textures = uint32_t(desc.textures.size());
    if (VkResult vk = allocateSet(c, impl->pool, impl->set); vk != VK_SUCCESS)
        return failure(c.device.sink(), Status::DeviceError, "allocating the scene's descriptor set failed", vk);
    c.device.name(VK_OBJECT_TYPE_DESCRIPTOR_SET, handleValue(impl->set), "scene");
    writeSet(c.device, impl->set, desc);
    return Scene(std::move(impl));
}

}   // namespace restir
