#pragma once

#include <memory>

#include <restir/device.h>
#include <restir/result.h>
#include <restir/version.h>

namespace restir {

// SPIR-V for every pass. The SDK embeds one built with the standard bridge; a host with its own bridge builds
// another with restir_compile_passes().
struct ShaderPack {
    uint32_t shaderAbi = 0;   // RESTIR_SHADER_ABI of the headers it was compiled with
    struct Module {
        const char* pass;   // "di.temporal"
        const uint32_t* words;
        size_t wordCount;
        bool traces = false;   // RayBackend::Pipeline: a ray generation shader
    };
    std::span<const Module> modules;
    RayBackend rays = RayBackend::RayQuery;   // what its passes trace with
};

// When the pipelines of the passes are made.
enum class PipelineCreation : uint8_t {
    All,        // by Context::create()
    OnDemand,   // by LightTable::create(), by Session::makePipelines(), else by Session::record() and prepare()
};

struct ContextDesc {
    DeviceInfo device;
    RayBackend rays = RayBackend::RayQuery;   // as `shaders`
    const ShaderPack* shaders = nullptr;   // null: the embedded pack of `rays`; with OnDemand its `modules` outlive the Context
    PipelineCreation pipelines = PipelineCreation::All;
    uint32_t framesInFlight = 2;           // [1, 16], one value for every object made from this
    uint32_t queueFamily = 0;              // where all of it is submitted; decides whether timestamps exist
    uint32_t maxTextures = 1024;           // of the standard scene set
    // Set 1 of a host's own bridge, for compute and, with RayBackend::Pipeline, ray generation and any-hit
    // shaders; null: Scene's.
    VkDescriptorSetLayout bridgeSetLayout = VK_NULL_HANDLE;
};

// Pipelines and layouts: everything that depends on the device and not on a view. Any number of threads may make other
// objects from one Context, and use those.
class Context {
public:
    static Result<Context> create(const ContextDesc& desc) noexcept;
    Context(Context&&) noexcept;
    Context& operator=(Context&&) noexcept;
    ~Context();   // everything made from it is gone already (before an assignment, too), and the GPU is done with it

    struct Impl;

private:
    friend struct Internals;
    explicit Context(std::unique_ptr<Impl> impl) noexcept;
    std::unique_ptr<Impl> impl_;
};

}   // namespace restir
