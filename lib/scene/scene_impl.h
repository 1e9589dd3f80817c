#pragma once

#include <device/device.h>
#include <restir/scene.h>

namespace restir {

struct Scene::Impl {
    const Context::Impl* context = nullptr;
    const Device* device = nullptr;
    uint32_t textures = 0;
    VkDescriptorPool pool = VK_NULL_HANDLE;
    VkDescriptorSet set = VK_NULL_HANDLE;

    ~Impl() {
        if (pool) device->functions.vkDestroyDescriptorPool(device->info.device, pool, device->allocator());
    }
};

}   // namespace restir
