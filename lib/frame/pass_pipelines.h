// A pipeline for each pass, made with the Context or when it is first needed.
#pragma once

#include <array>
#include <atomic>
#include <mutex>

#include <device/device.h>
#include <rays/pipelines.h>
#include <restir/context.h>

namespace restir {

class PassPipelines {
public:
    struct Layouts {
        VkPipelineLayout frame = VK_NULL_HANDLE;
        VkPipelineLayout lights = VK_NULL_HANDLE;   // of passes lights.*
    };
    struct Entry {
        const char* pass = "";
        std::atomic<VkPipeline> pipeline = VK_NULL_HANDLE;   // not of a pass that was required
        int traced = -1;                                     // in the binding table; < 0: a compute pipeline
        std::mutex making = {};
    };

    PassPipelines() = default;
    PassPipelines(const PassPipelines&) = delete;
    PassPipelines& operator=(const PassPipelines&) = delete;
    ~PassPipelines();

    // `device` outlives this, and so do `pack`'s modules with PipelineCreation::OnDemand.
    Result<bool> create(const Device& device, const Layouts& layouts, const ShaderPack& pack, PipelineCreation when) noexcept;
    // Makes what is missing, from any thread. What is there is found without waiting for what another one makes.
    Result<bool> require(const char* pass) const noexcept;

    const Entry& of(const char* pass) const noexcept;   // of a pass in all()
    std::span<const Entry> all() const noexcept { return entries_; }
    void trace(VkCommandBuffer cmd, const Entry& entry, uint32_t width, uint32_t height) const noexcept {
        table_.trace(*device_, cmd, uint32_t(entry.traced), width, height);
    }

private:
    Result<bool> make(Entry& entry) const noexcept;
    Result<bool> makeTable(int pipelines) noexcept;
    Result<bool> writeTable(const Entry& entry, VkPipeline pipeline) const noexcept;

    const Device* device_ = nullptr;
    Layouts layouts_;
    ShaderPack pack_;
    RayStages stages_;   // RayBackend::Pipeline, and so is the table
    BindingTable table_;
    PipelineCreation when_ = PipelineCreation::All;
    mutable std::array<Entry, 38> entries_{{{"surface.pack"},
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
                                            {"gi.pair_targets"},
                                            {"gi.pair_spatial"},
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
};

}   // namespace restir
