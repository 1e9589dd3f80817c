#include "common/denoiser.h"

#include <vector>

#include <restir/session.h>

#include "denoise_compose.spv.h"
#include "denoise_filter.spv.h"
#include "denoise_temporal.spv.h"

namespace samples {
namespace {

enum Flags : uint32_t { kHistory = 1, kGradient = 2, kDirect = 4, kIndirect = 8 };

// Constants in denoise.glsl.
struct Constants {
    CameraPose pose, previous;
    int32_t extent[2];
    uint32_t flags;
    int32_t stride;
};
static_assert(sizeof(Constants) == 112);

constexpr Access kShared{VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                         VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
                         VK_IMAGE_LAYOUT_GENERAL};

uint32_t flagsOf(const restir::Settings& settings) {
    uint32_t flags = 0;
    if (settings.di.mode != restir::DirectMode::Off) flags |= kDirect;
    if (settings.di.mode == restir::DirectMode::Restir) flags |= kGradient;
    if (settings.gi.mode != restir::IndirectMode::Off) flags |= kIndirect;
    return flags;
}

}   // namespace

struct Denoiser::Images {
    Images(const Device& device, VkExtent2D extent) {
        for (GpuImage* image : all())
            *image = GpuImage(device, extent, VK_FORMAT_R32G32B32A32_SFLOAT, VK_IMAGE_USAGE_STORAGE_BIT);
        device.submitAndWait([&](VkCommandBuffer cmd) {
            for (const GpuImage* image : all()) pipelineBarrier(cmd, {{imageBarrier(*image, {}, kShared)}});
        });
    }
    std::vector<GpuImage*> all() {
        std::vector<GpuImage*> list = {&gradient, &geometry, &moments, &oldGeometry, &oldMoments, &radiance};
        for (Lobes* lobes : {&direct, &indirect, &old, &a, &b})
            list.insert(list.end(), {&lobes->diffuse, &lobes->specular});
        return list;
    }

    struct Lobes {
        GpuImage diffuse, specular;
    };
    Lobes direct, indirect;   // of the SDK
    GpuImage radiance;        // which nobody looks at
    GpuImage gradient;
    GpuImage geometry, moments, oldGeometry, oldMoments;
    Lobes old, a, b;   // the mean of frames, once filtered, and what filters go to and fro between
};

Denoiser::Denoiser(const Device& device, const GpuScene& scene, const GBufferPass& gbuffer,
                   VkImageView target, VkExtent2D extent)
    : images_(std::make_unique<Images>(device, extent)), extent_(extent) {
    const Images& i = *images_;
    const restir::GBuffer g = gbuffer.describe();
    const auto make = [&](std::span<const uint32_t> spirv, const std::vector<VkImageView>& views) {
        return std::make_unique<ScenePass>(device, scene, spirv, views, uint32_t(sizeof(Constants)));
    };
    temporal_ = make(
        k_denoise_temporal_spv,
        {g.depth.view, g.geometricNormal.view, g.motion.view, i.direct.diffuse.view(),
         i.direct.specular.view(), i.indirect.diffuse.view(), i.indirect.specular.view(), i.gradient.view(),
         i.oldGeometry.view(), i.oldMoments.view(), i.old.diffuse.view(), i.old.specular.view(),
         i.geometry.view(), i.moments.view(), i.a.diffuse.view(), i.a.specular.view()});
    const auto filter = [&](const Images::Lobes& from, const Images::Lobes& to) {
        return make(k_denoise_filter_spv,
                    {i.geometry.view(), g.normal.view, g.material.view, from.diffuse.view(),
                     from.specular.view(), to.diffuse.view(), to.specular.view()});
    };
    filters_ = {filter(i.a, i.old), filter(i.old, i.b), filter(i.b, i.a), filter(i.a, i.b)};
    compose_ =
        make(k_denoise_compose_spv,
             {g.baseColor.view, g.material.view, g.emission.view, i.a.diffuse.view(), i.a.specular.view(),
              i.geometry.view(), i.moments.view(), i.oldGeometry.view(), i.oldMoments.view(), target});
}

Denoiser::~Denoiser() = default;

void Denoiser::ask(restir::Output& output, const restir::Settings& settings) const {
    const uint32_t flags = flagsOf(settings);
    output.radiance = images_->radiance.view();
    if (flags & kDirect) {
        output.diffuse = images_->direct.diffuse.view();
        output.specular = images_->direct.specular.view();
    }
    if (flags & kIndirect) {
        output.indirectDiffuse = images_->indirect.diffuse.view();
        output.indirectSpecular = images_->indirect.specular.view();
    }
    if (flags & kGradient) output.gradient = images_->gradient.view();
}

void Denoiser::record(VkCommandBuffer cmd, const restir::Scope& out, const restir::Settings& settings,
                      const CameraPose& pose, const CameraPose& previous) {
    memoryBarrier(cmd, {out.stages, out.access}, kShared);
    const auto run = [&](const ScenePass& pass, int32_t stride) {
        pass.record(cmd, extent_,
                    Constants{.pose = pose,
                              .previous = previous,
                              .extent = {int32_t(extent_.width), int32_t(extent_.height)},
                              .flags = flagsOf(settings) | (history_ ? kHistory : 0u),
                              .stride = stride});
        memoryBarrier(cmd, kShared, kShared);
    };
    run(*temporal_, 0);
    run(*filters_[0], 1);    // a to old, which the next frame goes on with
    run(*filters_[1], 2);    // to b
    run(*filters_[2], 4);    // to a
    run(*filters_[3], 8);    // to b
    run(*filters_[2], 16);   // to a
    run(*compose_, 0);
    history_ = true;
}

}   // namespace samples
