#pragma once

#include <array>
#include <atomic>

#include <device/device.h>
#include <rays/pipelines.h>
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

    struct Pipeline {
        const char* pass = "";
        VkPipeline pipeline = VK_NULL_HANDLE;
        int traced = -1;   // in `bindingTable`; < 0: a compute pipeline
    };
    std::array<Pipeline, 36> pipelines{{{"surface.pack"},
                                       {"di.candidates"},
                                       {"di.temporal"},
                                       {"di.spatiotemporal"},
                                       {"di.boiling"},
                                       {"di.spatial"},
                                       {"di.pair_targets"},
                                       {"di.pair_spatial"},
                                       {"di.shade"},
                                       {"di.fill"},
                                       {"di.gradient"},
                                       {"di.debug"},
                                       {"di.next_event"},
                                       {"di.off"},
                                       {"gi.candidates"},
                                       {"gi.temporal"},
                                       {"gi.boiling"},
                                       {"gi.spatial"},
                                       {"gi.shade"},
                                       {"gi.fill"},
                                       {"lights.means"},
                                       {"lights.meshes"},
                                       {"lights.extent"},
                                       {"lights.power"},
                                       {"lights.sum"},
                                       {"lights.scale"},
                                       {"lights.reduce"},
                                       {"lights.prefix"},
                                       {"lights.scan"},
                                       {"lights.alias"},
                                       {"lights.keys"},
                                       {"lights.count"},
                                       {"lights.offsets"},
                                       {"lights.sort"},
                                       {"lights.split"},
                                       {"lights.nodes"}}};

    BindingTable bindingTable;   // RayBackend::Pipeline

    const Pipeline& pipelineOf(const char* pass) const noexcept;
    ~Impl();
};

}   // namespace restir
