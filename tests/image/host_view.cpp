#include "image/host_view.h"

#include <cstring>

#include "image/world.h"

namespace tests {
namespace {

using samples::Access;

constexpr Access kCopyFrom{VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_READ_BIT,
                           VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL};
constexpr Access kCopyTo{VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                         VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL};

VkDeviceSize bytesOf(VkExtent2D extent) {
    return VkDeviceSize{extent.width} * extent.height * sizeof(glm::vec4);
}

VkBufferImageCopy wholeImage(VkExtent2D extent) {
    return {.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
            .imageExtent = {extent.width, extent.height, 1}};
}

template <class T>
std::unique_ptr<T> made(restir::Result<T> result, const char* what) {
    return std::make_unique<T>(device().require(std::move(result), what));
}

}   // namespace

restir::ContextDesc HostView::contextDesc() {
    restir::ContextDesc desc;
    desc.device = device().sdkInfo();
    desc.framesInFlight = kSlots;
    desc.queueFamily = device().queueFamily();
    desc.rays = device().bestRays();
    desc.maxTextures = 4;
    desc.pipelines = restir::PipelineCreation::OnDemand;   // most tests need a few of them
    return desc;
}

HostView::HostView(const samples::GpuScene& scene, const samples::View& view, const HostDesc& desc)
    : scene_(scene), view_(view), desc_(desc) {
    if (desc_.maxLights == 0) desc_.maxLights = scene.maxLights();
    for (uint32_t i = 0; i < kSlots; ++i) {
        for (size_t t = 0; t < targetCount(); ++t) {
            targets_[i][t] = samples::GpuImage(device(), desc.maxExtent, VK_FORMAT_R32G32B32A32_SFLOAT,
                                               VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT);
            readbacks_[i][t] = samples::Buffer(device(), {.size = bytesOf(desc.maxExtent),
                                                          .usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                                          .memory = samples::MemoryKind::Readback});
        }
    }
    restir::ContextDesc contextInfo = contextDesc();
    contextInfo.device.memory = desc.memory;
    contextInfo.shaders = desc.shaders;
    if (!desc.rays) desc_.rays = desc.shaders ? desc.shaders->rays : contextInfo.rays;
    contextInfo.rays = *desc_.rays;
    context_ = desc.context;
    if (!context_) context_ = made(restir::Context::create(contextInfo), "Context");
    const restir::SceneDesc sceneInfo{
        .instances = scene.instances(), .materials = scene.materials(), .textures = scene.textures()};
    sdkScene_ = made(restir::Scene::create(*context_, sceneInfo), "Scene");
    lights_ = made(restir::LightTable::create(*context_, {.maxLights = desc_.maxLights}), "LightTable");
    if (desc.rays == restir::RayBackend::Software) makeBvh();
    newSession();
    resize(desc.maxExtent);
    upload(scene.lights());
}

HostView::~HostView() { device().waitIdle(); }

void HostView::makeBvh() {
    const std::vector<restir::BvhMesh> meshes = scene_.makeBvhMeshes();
    const std::vector<restir::BvhInstance> instances = scene_.bvhInstances();
    bvh_ = made(restir::Bvh::create(*context_, {.meshes = meshes, .maxInstances = uint32_t(instances.size())}), "Bvh");
    device().submitAndWait([&](VkCommandBuffer cmd) { device().check(bvh_->record(cmd, 0, instances), "Bvh::record"); });
}

void HostView::newSession() {
    session_.reset();
    const restir::SessionDesc info{.maxExtent = desc_.maxExtent,
                                   .pairedNeighbours = desc_.pairedNeighbours,
                                   .indirect = desc_.indirect,
                                   .rayLogCapacity = desc_.rayLogCapacity};
    session_ = made(restir::Session::create(*context_, info), "Session");
}

void HostView::look(const samples::View& view) {
    const samples::CameraPose pose = samples::makePose(view, extent_),
                              before = samples::makePose(view_, extent_);
    view_ = view;
    device().submitAndWait([&](VkCommandBuffer cmd) {
        gbuffers_.back()->record(cmd, pose, before, {0, 0}, restir::Session::inputScope(*desc_.rays));
    });
}

void HostView::upload(std::span<const restir::Light> lights) {
    device().check(lights_->upload(0, lights), "LightTable::upload");
    device().submitAndWait(
        [&](VkCommandBuffer cmd) { device().check(lights_->record(cmd, 0), "LightTable::record"); });
}

void HostView::resize(VkExtent2D extent) {
    extent_ = extent;
    gbuffers_.push_back(std::make_unique<samples::GBufferPass>(device(), scene_, extent));
    const samples::CameraPose pose = samples::makePose(view_, extent);
    device().submitAndWait([&](VkCommandBuffer cmd) {
        gbuffers_.back()->record(cmd, pose, pose, {0, 0}, restir::Session::inputScope(*desc_.rays));
    });
}

restir::FrameInput HostView::input(uint32_t index) const {
    restir::FrameInput input;
    input.frameSlot = index % kSlots;
    input.frameIndex = index;
    input.extent = extent_;
    input.camera = samples::sdkCamera(samples::makePose(view_, extent_), {0, 0});
    input.gbuffer = gbuffers_.back()->describe();
    input.tlas = scene_.tlas();
    input.bvh = bvh_.get();
    input.scene = sdkScene_.get();
    input.lights = lights_.get();
    const auto& targets = targets_[input.frameSlot];
    input.output = {.radiance = targets[size_t(Target::Radiance)].view(),
                    .diffuse = targets[size_t(Target::Diffuse)].view(),
                    .specular = targets[size_t(Target::Specular)].view(),
                    .gradient = targets[size_t(Target::Gradient)].view(),
                    .debug = targets[size_t(Target::Debug)].view()};
    return input;
}

void HostView::addIndirectLobes(restir::FrameInput& input) const {
    const auto& targets = targets_[input.frameSlot];
    input.output.indirectDiffuse = targets[size_t(Target::IndirectDiffuse)].view();
    input.output.indirectSpecular = targets[size_t(Target::IndirectSpecular)].view();
}

void HostView::record(VkCommandBuffer cmd, restir::Session& session, const restir::FrameInput& input,
                      const restir::Settings& settings) {
    around(cmd, input, [&] { device().check(session.record(cmd, input, settings), "Session::record"); });
}

void HostView::around(VkCommandBuffer cmd, const restir::FrameInput& input,
                      const std::function<void()>& passes) {
    const restir::Scope scope = restir::Session::outputScope(*desc_.rays);
    const Access written{scope.stages, scope.access, VK_IMAGE_LAYOUT_GENERAL};
    const Access before{kCopyFrom.stages, 0, VK_IMAGE_LAYOUT_UNDEFINED};   // last use was copied
    const auto barriers = [&](const Access& from, const Access& to) {
        for (size_t t = 0; t < targetCount(); ++t)
            samples::pipelineBarrier(cmd, {{samples::imageBarrier(targets_[input.frameSlot][t], from, to)}});
    };
    barriers(before, written);
    passes();
    barriers(written, kCopyFrom);
    VkExtent2D& extent = extents_[input.frameSlot];
    extent.width = input.extent.width + uint32_t(input.output.origin.x);
    extent.height = input.extent.height + uint32_t(input.output.origin.y);
    const VkBufferImageCopy region = wholeImage(extent);
    for (size_t t = 0; t < targetCount(); ++t)
        vkCmdCopyImageToBuffer(cmd, targets_[input.frameSlot][t].handle(), kCopyFrom.layout,
                               readbacks_[input.frameSlot][t].handle(), 1, &region);
    samples::memoryBarrier(cmd, kCopyTo, {VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT});
}

samples::FloatImage HostView::read(uint32_t slot) const {
    const VkExtent2D extent = extents_[slot];
    samples::FloatImage image{extent.width, extent.height, {}};
    for (const glm::vec4& pixel : read(slot, Target::Radiance))
        image.rgb.insert(image.rgb.end(), {pixel.x, pixel.y, pixel.z});
    return image;
}

std::span<const glm::vec4> HostView::read(uint32_t slot, Target target) const {
    const VkExtent2D extent = extents_[slot];
    return {reinterpret_cast<const glm::vec4*>(readbacks_[slot][size_t(target)].mapped()),
            size_t{extent.width} * extent.height};
}

samples::FloatImage HostView::frame(const restir::FrameInput& input, const restir::Settings& settings) {
    device().submitAndWait([&](VkCommandBuffer cmd) { record(cmd, input, settings); });
    return read(input.frameSlot);
}

samples::FloatImage HostView::frames(uint32_t first, uint32_t count, const restir::Settings& settings,
                                     uint32_t seed) {
    samples::FloatImage image;
    for (uint32_t i = first; i < first + count; ++i) {
        restir::FrameInput in = input(i);
        in.seed = seed;
        image = frame(in, settings);
    }
    return image;
}

samples::GpuImage floatImage(VkExtent2D extent, const std::vector<glm::vec4>& texels) {
    samples::GpuImage image(device(), extent, VK_FORMAT_R32G32B32A32_SFLOAT,
                            VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT);
    const samples::Buffer staging(device(), {.size = bytesOf(extent),
                                             .usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                                             .memory = samples::MemoryKind::Upload});
    std::memcpy(staging.mapped(), texels.data(), bytesOf(extent));
    const restir::Scope scope = restir::Session::inputScope(device().bestRays());
    const Access read{scope.stages, scope.access, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
    device().submitAndWait([&](VkCommandBuffer cmd) {
        samples::pipelineBarrier(cmd, {{samples::imageBarrier(image, {}, kCopyTo)}});
        const VkBufferImageCopy region = wholeImage(extent);
        vkCmdCopyBufferToImage(cmd, staging.handle(), image.handle(), kCopyTo.layout, 1, &region);
        samples::pipelineBarrier(cmd, {{samples::imageBarrier(image, kCopyTo, read)}});
    });
    return image;
}

}   // namespace tests
