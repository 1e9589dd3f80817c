#include "own_bridge/host.h"

#include <cstring>

#include <restir_embedded.h>

#include "visibility.spv.h"
#include "visibility_raygen.spv.h"

namespace own_bridge {
namespace {

using samples::Access;
using samples::check;

constexpr Access kCopyFrom{VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_READ_BIT,
                           VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL};

struct VisibilityConstants {
    samples::CameraPose pose;
    VkExtent2D extent;
};

template <class T>
std::unique_ptr<T> made(const samples::Device& device, restir::Result<T> result, const char* what) {
    return std::make_unique<T>(device.require(std::move(result), what));
}

samples::Buffer storage(const samples::Device& device, VkDeviceSize size, samples::MemoryKind memory) {
    return {device, {.size = size, .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, .memory = memory}};
}

VkDeviceSize bytesOf(VkExtent2D extent) { return VkDeviceSize{16} * extent.width * extent.height; }

}   // namespace

std::vector<Paint> paintsOf(const samples::SceneData& scene) {
    std::vector<Paint> paints;
    for (const auto& m : scene.materials)
        paints.push_back({.color = {m.baseColor.x, m.baseColor.y, m.baseColor.z},
                          .retro = m.metalness > 0.5f ? 4.0f : 0.0f,
                          .emission = {m.emission.x, m.emission.y, m.emission.z},
                          .twoSided = (m.flags & RS_MATERIAL_DOUBLE_SIDED) != 0 ? 1u : 0u});
    return paints;
}

Host::Host(samples::Device& device, const samples::GpuScene& scene, std::span<const Paint> paints,
           VkExtent2D extent, restir::RayBackend rays)
    : device_(device),
      scene_(scene),
      extent_(extent),
      rays_(rays),
      visibility_(storage(device, bytesOf(extent), samples::MemoryKind::Gpu)),
      paints_(storage(device, paints.size_bytes(), samples::MemoryKind::Upload)),
      visibilityPass_(device, scene, samples::tracingShader(device, k_visibility_spv, k_visibility_raygen_spv), {},
                      sizeof(VisibilityConstants), {{visibility_.handle()}}) {
    for (size_t i = 0; i < TargetCount; ++i) {
        targets_[i] = samples::GpuImage(device, extent, VK_FORMAT_R32G32B32A32_SFLOAT,
                                        VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT);
        readbacks_[i] = samples::Buffer(device, {.size = bytesOf(extent),
                                                 .usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                                 .memory = samples::MemoryKind::Readback});
    }
    makeSet(paints);
    makeSdkObjects();
}

Host::~Host() {
    device_.waitIdle();
    session_.reset();
    lights_.reset();
    context_.reset();
    vkDestroyDescriptorPool(device_.handle(), pool_, nullptr);
    vkDestroyDescriptorSetLayout(device_.handle(), setLayout_, nullptr);
}

// Set 1: what the bridge reads.
void Host::makeSet(std::span<const Paint> paints) {
    std::memcpy(paints_.mapped(), paints.data(), paints.size_bytes());
    VkShaderStageFlags stages = VK_SHADER_STAGE_COMPUTE_BIT;
    if (rays_ == restir::RayBackend::Pipeline)
        stages |= VK_SHADER_STAGE_RAYGEN_BIT_KHR | VK_SHADER_STAGE_ANY_HIT_BIT_KHR;
    VkDescriptorSetLayoutBinding bindings[3];
    for (uint32_t i = 0; i < 3; ++i)
        bindings[i] = {i, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, stages, nullptr};
    const VkDescriptorSetLayoutCreateInfo layoutInfo{
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
        .bindingCount = 3,
        .pBindings = bindings};
    check(vkCreateDescriptorSetLayout(device_.handle(), &layoutInfo, nullptr, &setLayout_),
          "vkCreateDescriptorSetLayout");
    const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 3};
    const VkDescriptorPoolCreateInfo poolInfo{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                                              .maxSets = 1,
                                              .poolSizeCount = 1,
                                              .pPoolSizes = &size};
    check(vkCreateDescriptorPool(device_.handle(), &poolInfo, nullptr, &pool_), "vkCreateDescriptorPool");
    const VkDescriptorSetAllocateInfo info{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
                                           .descriptorPool = pool_,
                                           .descriptorSetCount = 1,
                                           .pSetLayouts = &setLayout_};
    check(vkAllocateDescriptorSets(device_.handle(), &info, &set_), "vkAllocateDescriptorSets");
    const VkDescriptorBufferInfo buffers[] = {{visibility_.handle(), 0, VK_WHOLE_SIZE},
                                              {scene_.instances(), 0, VK_WHOLE_SIZE},
                                              {paints_.handle(), 0, VK_WHOLE_SIZE}};
    const VkWriteDescriptorSet write{.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                                     .dstSet = set_,
                                     .descriptorCount = 3,   // on into the bindings that follow
                                     .descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                                     .pBufferInfo = buffers};
    vkUpdateDescriptorSets(device_.handle(), 1, &write, 0, nullptr);
}

void Host::makeSdkObjects() {
    restir::ContextDesc desc;
    desc.device = device_.sdkInfo();
    // The passes with this host's bridge, and its set 1 instead of a restir::Scene.
    desc.shaders = rays_ == restir::RayBackend::Pipeline ? &kEmbeddedPipelinePack : &kEmbeddedQueryPack;
    desc.bridgeSetLayout = setLayout_;
    desc.rays = rays_;
    desc.pipelines = restir::PipelineCreation::OnDemand;   // one kind of settings needs a few of them
    desc.framesInFlight = 1;
    desc.queueFamily = device_.queueFamily();
    context_ = made(device_, restir::Context::create(desc), "restir::Context");
    // All lights are paint, which the bridge shows to the SDK: there is nothing to upload but where.
    const restir::LightTableDesc lights{.maxLights = scene_.maxLights(),
                                        .meshLights = scene_.maxLights(),
                                        .maxMeshes = static_cast<uint32_t>(scene_.lightMeshes().size())};
    lights_ = made(device_, restir::LightTable::create(*context_, lights), "restir::LightTable");
    session_ = made(device_,
                    restir::Session::create(
                        *context_, {.maxExtent = extent_, .pairedNeighbours = restir::kPresetPartners}),
                    "restir::Session");
    device_.check(lights_->uploadMeshes(0, scene_.lightMeshes()), "restir::LightTable::uploadMeshes");
    device_.submitAndWait([&](VkCommandBuffer cmd) {
        device_.check(lights_->record(cmd, 0, nullptr, set_), "restir::LightTable::record");
    });
}

void Host::frame(const samples::View& view, uint64_t index, uint32_t seed, const restir::Settings& settings,
                 bool reset) {
    const samples::CameraPose pose = samples::makePose(view, extent_);
    restir::FrameInput input;
    input.frameIndex = index;
    input.seed = seed;
    input.extent = extent_;
    input.camera = samples::sdkCamera(pose, {0, 0});
    input.tlas = scene_.tlas();
    input.bridgeSet = set_;
    input.lights = lights_.get();
    input.output = {.radiance = targets_[Radiance].view(),
                    .diffuse = targets_[Diffuse].view(),
                    .specular = targets_[Specular].view()};
    input.resetHistory = reset;
    const restir::Scope readers = restir::Session::inputScope(rays_), writer = restir::Session::outputScope(rays_);
    const Access lit{writer.stages, writer.access, VK_IMAGE_LAYOUT_GENERAL};
    device_.submitAndWait([&](VkCommandBuffer cmd) {
        visibilityPass_.record(cmd, extent_, VisibilityConstants{pose, extent_});
        samples::memoryBarrier(cmd, {visibilityPass_.stage(), VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT},
                               {readers.stages, readers.access});
        for (const samples::GpuImage& target : targets_)
            samples::pipelineBarrier(
                cmd, {{samples::imageBarrier(target, {kCopyFrom.stages, 0, VK_IMAGE_LAYOUT_UNDEFINED},
                                             lit)}});
        device_.check(session_->record(cmd, input, settings), "restir::Session::record");
        const VkBufferImageCopy region{.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                                       .imageExtent = {extent_.width, extent_.height, 1}};
        for (size_t i = 0; i < TargetCount; ++i) {
            samples::pipelineBarrier(cmd, {{samples::imageBarrier(targets_[i], lit, kCopyFrom)}});
            vkCmdCopyImageToBuffer(cmd, targets_[i].handle(), kCopyFrom.layout, readbacks_[i].handle(), 1,
                                   &region);
        }
        samples::memoryBarrier(cmd, {VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT},
                               {VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT});
    });
}

samples::FloatImage Host::read(Target target) const {
    samples::FloatImage image{extent_.width, extent_.height, {}};
    const auto* texels = reinterpret_cast<const glm::vec4*>(readbacks_[target].mapped());
    for (size_t i = 0; i < size_t{extent_.width} * extent_.height; ++i)
        image.rgb.insert(image.rgb.end(), {texels[i].x, texels[i].y, texels[i].z});
    return image;
}

}   // namespace own_bridge
