#pragma once

#include <device/device.h>
#include <restir/scene.h>

namespace restir {

struct Scene::Impl {
    const Device* device = nullptr;
    VkDescriptorPool pool = VK_NULL_HANDLE;
    VkDescriptorSet set = VK_NULL_HANDLE;

    ~Impl() {
        if (pool) device->functions.vkDestroyDescriptorPool(device->info.device, pool, device->allocator());
    }
};

}   // namespace restir
