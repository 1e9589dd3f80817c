#include "common/device.h"

namespace samples {

FrameSlots::FrameSlots(const Device& device) : device_(device) {
    const VkCommandPoolCreateInfo poolInfo{.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                           .flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT,
                                           .queueFamilyIndex = device.queueFamily()};
    check(vkCreateCommandPool(device.handle(), &poolInfo, nullptr, &pool_), "vkCreateCommandPool");
    const VkCommandBufferAllocateInfo allocation{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                                 .commandPool = pool_,
                                                 .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
                                                 .commandBufferCount = kCount};
    check(vkAllocateCommandBuffers(device.handle(), &allocation, commands_), "vkAllocateCommandBuffers");
    const VkFenceCreateInfo fenceInfo{.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO,
                                      .flags = VK_FENCE_CREATE_SIGNALED_BIT};
    for (VkFence& fence : fences_) {
        check(vkCreateFence(device.handle(), &fenceInfo, nullptr, &fence), "vkCreateFence");
    }
}

FrameSlots::~FrameSlots() {
    device_.waitIdle();
    for (VkFence fence : fences_) vkDestroyFence(device_.handle(), fence, nullptr);
    vkDestroyCommandPool(device_.handle(), pool_, nullptr);
}

void FrameSlots::wait(uint32_t slot) const {
    check(vkWaitForFences(device_.handle(), 1, &fences_[slot], VK_TRUE, UINT64_MAX), "vkWaitForFences");
}

VkCommandBuffer FrameSlots::begin(uint32_t slot) {
    wait(slot);
    // A recording that an error cut short begins anew.
    check(vkResetCommandBuffer(commands_[slot], 0), "vkResetCommandBuffer");
    const VkCommandBufferBeginInfo begin{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                         .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT};
    check(vkBeginCommandBuffer(commands_[slot], &begin), "vkBeginCommandBuffer");
    return commands_[slot];
}

void FrameSlots::submit(uint32_t slot, const WindowSync* window) {
    check(vkEndCommandBuffer(commands_[slot]), "vkEndCommandBuffer");
    check(vkResetFences(device_.handle(), 1, &fences_[slot]), "vkResetFences");
    VkSubmitInfo info{
        .sType = VK_STRUCTURE_TYPE_SUBMIT_INFO, .commandBufferCount = 1, .pCommandBuffers = &commands_[slot]};
    if (window) {
        info.waitSemaphoreCount = 1;
        info.pWaitSemaphores = &window->acquired;
        info.pWaitDstStageMask = &window->waitingStages;
        info.signalSemaphoreCount = 1;
        info.pSignalSemaphores = &window->rendered;
    }
    check(vkQueueSubmit(device_.queue(), 1, &info, fences_[slot]), "vkQueueSubmit");
}

}   // namespace samples
