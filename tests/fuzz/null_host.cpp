#include "fuzz/null_host.h"

#include <array>

namespace fuzz {

const restir::Context& context() {
    static const restir::Result<restir::Context> made = restir::Context::create(
        {.device = nullDevice(), .framesInFlight = kFrames, .maxTextures = kTextures});
    return *made;
}

const restir::Scene& scene() {
    std::array<VkDescriptorImageInfo, kTextures> textures;
    textures.fill(
        {someHandle<VkSampler>(), someHandle<VkImageView>(), VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL});
    static const restir::Result<restir::Scene> made = restir::Scene::create(
        context(),
        {.instances = someHandle<VkBuffer>(), .materials = someHandle<VkBuffer>(), .textures = textures});
    return *made;
}

}   // namespace fuzz
