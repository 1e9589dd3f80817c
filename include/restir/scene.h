#pragma once

#include <memory>
#include <span>

#include <restir/context.h>
#include <restir/shared/scene.h>

namespace restir {

struct SceneDesc {
    // Both STORAGE_BUFFER, read in COMPUTE_SHADER. Their contents may change between frames (the host's
    // barriers), the handles may not: streaming hosts make another Scene.
    VkBuffer instances = VK_NULL_HANDLE;   // gpu::RsInstance[]; vertex data is reached by device address
    VkBuffer materials = VK_NULL_HANDLE;   // gpu::RsMaterial[]
    // Combined image samplers; RsMaterial's and Light's texture indices point here. At most
    // ContextDesc::maxTextures. Images stay in `imageLayout` while frames that use them run.
    std::span<const VkDescriptorImageInfo> textures;
};

// The standard scene contract as descriptor set 1: what rays hit and what the hits mean. Borrows everything in
// `desc`. Make another one when handles change; destroy it when the GPU is done with its last frame.
class Scene {
public:
    static Result<Scene> create(const Context& context, const SceneDesc& desc) noexcept;
    Scene(Scene&&) noexcept;
    Scene& operator=(Scene&&) noexcept;
    ~Scene();

    struct Impl;

private:
    friend struct Internals;
    explicit Scene(std::unique_ptr<Impl> impl) noexcept;
    std::unique_ptr<Impl> impl_;
};

}   // namespace restir
