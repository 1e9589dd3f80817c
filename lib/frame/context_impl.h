#pragma once

#include <atomic>

#include <device/device.h>
#include <frame/pass_pipelines.h>
#include <restir/context.h>
#include <restir/shared/frame.h>

namespace restir {

struct Context::Impl {
    Device device;
    RayBackend rays = RayBackend::RayQuery;
    uint32_t framesInFlight = 0;
    uint32_t maxTextures = 0;
    mutable std::atomic<uint64_t> lightTables = 0;   // made so far
    mutable std::atomic<uint64_t> bvhs = 0;
    bool ownsSceneLayout = false;
    VkDescriptorSetLayout frameLayout = VK_NULL_HANDLE;   // set 0
    VkDescriptorSetLayout sceneLayout = VK_NULL_HANDLE;   // set 1: ours or the host's bridge's
    VkPipelineLayout pipelineLayout = VK_NULL_HANDLE;
    VkDescriptorSetLayout tableLayout = VK_NULL_HANDLE;   // set 0 of LightTable's passes
    VkPipelineLayout tablePipelineLayout = VK_NULL_HANDLE;

    PassPipelines pipelines;

    ~Impl();
};

}   // namespace restir
