#pragma once

#include <memory>
#include <span>

#include <restir/context.h>

namespace restir {

// The component restir::compiler: at run time what restir_compile_passes() does at build time, with the
// glslang library.

struct CompileDesc {
    // As CMake's property RESTIR_SHADER_DIRS of restir::shaders names them, or pkg-config's variables. Both
    // required.
    const char* includeDirectory = nullptr;   // has restir/shared
    const char* shaderDirectory = nullptr;    // has restir, passes and standard
    const char* bridgeDirectory = nullptr;    // has the host's restir_bridge.glsl; null: the standard one
    RayBackend rays = RayBackend::RayQuery;
    const char* raysDirectory = nullptr;   // has the host's restir_rays.glsl; for RayBackend::Own
    // "di.shade"; empty: all of shaderDirectory. With RayBackend::Pipeline the stages they share come along.
    std::span<const char* const> passes;
    // What the compiler has to say, a line each: "restir: <file>:<line>: <message> (<pass>)".
    MessageSink messages;
};

// SPIR-V for a Context.
class CompiledPack {
public:
    CompiledPack(CompiledPack&&) noexcept;
    CompiledPack& operator=(CompiledPack&&) noexcept;
    ~CompiledPack();

    // For ContextDesc::shaders. Lives as long as this.
    const ShaderPack& pack() const noexcept;

    struct Impl;

private:
    friend Result<CompiledPack> compilePasses(const CompileDesc& desc) noexcept;
    explicit CompiledPack(std::unique_ptr<Impl> impl) noexcept;
    std::unique_ptr<Impl> impl_;
};

// Takes a second or two for all passes. Stops at the first that does not compile. Any number of threads may
// call it.
Result<CompiledPack> compilePasses(const CompileDesc& desc) noexcept;

}   // namespace restir
