#include "viewer/swapchain.h"

#include <algorithm>
#include <stdexcept>

namespace viewer {
namespace {

VkSemaphore makeSemaphore(VkDevice device) {
    const VkSemaphoreCreateInfo info{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO};
    VkSemaphore semaphore = VK_NULL_HANDLE;
    samples::check(vkCreateSemaphore(device, &info, nullptr, &semaphore), "vkCreateSemaphore");
    return semaphore;
}

}   // namespace

Swapchain::Swapchain(const samples::Device& device) : device_(device) {
    chooseFormat();
    for (VkSemaphore& semaphore : acquired_) semaphore = makeSemaphore(device.handle());
}

Swapchain::~Swapchain() {
    releaseImages();
    vkDestroySwapchainKHR(device_.handle(), handle_, nullptr);
    for (VkSemaphore semaphore : acquired_) vkDestroySemaphore(device_.handle(), semaphore, nullptr);
}

// Eight bits that are shown as they are: the tone map encodes them.
void Swapchain::chooseFormat() {
    uint32_t count = 0;
    samples::check(
        vkGetPhysicalDeviceSurfaceFormatsKHR(device_.physical(), device_.surface(), &count, nullptr),
        "vkGetPhysicalDeviceSurfaceFormatsKHR");
    std::vector<VkSurfaceFormatKHR> formats(count);
    samples::check(
        vkGetPhysicalDeviceSurfaceFormatsKHR(device_.physical(), device_.surface(), &count, formats.data()),
        "vkGetPhysicalDeviceSurfaceFormatsKHR");
    for (const VkSurfaceFormatKHR& candidate : formats) {
        if (candidate.format != VK_FORMAT_B8G8R8A8_UNORM && candidate.format != VK_FORMAT_R8G8B8A8_UNORM)
            continue;
        format_ = candidate.format;
        colors_ = candidate.colorSpace;
        return;
    }
    throw std::runtime_error("the window's surface has no format of eight bits without a conversion");
}

void Swapchain::releaseImages() {
    for (VkImageView view : views_) vkDestroyImageView(device_.handle(), view, nullptr);
    for (VkSemaphore semaphore : rendered_) vkDestroySemaphore(device_.handle(), semaphore, nullptr);
    views_.clear();
    rendered_.clear();
    images_.clear();
}

void Swapchain::resize(VkExtent2D window) {
    VkSurfaceCapabilitiesKHR can;
    samples::check(vkGetPhysicalDeviceSurfaceCapabilitiesKHR(device_.physical(), device_.surface(), &can),
                   "vkGetPhysicalDeviceSurfaceCapabilitiesKHR");
    const VkImageUsageFlags needed = VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    if ((can.supportedUsageFlags & needed) != needed)
        throw std::runtime_error("the window's surface cannot be copied to");
    usage_ = needed | (can.supportedUsageFlags & VK_IMAGE_USAGE_TRANSFER_SRC_BIT);
    extent_ = can.currentExtent;
    if (extent_.width == UINT32_MAX)
        extent_ = {std::clamp(window.width, can.minImageExtent.width, can.maxImageExtent.width),
                   std::clamp(window.height, can.minImageExtent.height, can.maxImageExtent.height)};
    const uint32_t most = can.maxImageCount > 0 ? can.maxImageCount : UINT32_MAX;
    const VkSwapchainKHR old = handle_;
    const VkSwapchainCreateInfoKHR info{.sType = VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR,
                                        .surface = device_.surface(),
                                        .minImageCount = std::min(can.minImageCount + 1, most),
                                        .imageFormat = format_,
                                        .imageColorSpace = colors_,
                                        .imageExtent = extent_,
                                        .imageArrayLayers = 1,
                                        .imageUsage = usage_,
                                        .preTransform = can.currentTransform,
                                        .compositeAlpha = VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR,
                                        .presentMode = VK_PRESENT_MODE_FIFO_KHR,
                                        .clipped = VK_TRUE,
                                        .oldSwapchain = old};
    releaseImages();
    samples::check(vkCreateSwapchainKHR(device_.handle(), &info, nullptr, &handle_), "vkCreateSwapchainKHR");
    vkDestroySwapchainKHR(device_.handle(), old, nullptr);
    uint32_t count = 0;
    samples::check(vkGetSwapchainImagesKHR(device_.handle(), handle_, &count, nullptr),
                   "vkGetSwapchainImagesKHR");
    images_.resize(count);
    samples::check(vkGetSwapchainImagesKHR(device_.handle(), handle_, &count, images_.data()),
                   "vkGetSwapchainImagesKHR");
    for (VkImage image : images_) {
        const VkImageViewCreateInfo viewInfo{.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
                                             .image = image,
                                             .viewType = VK_IMAGE_VIEW_TYPE_2D,
                                             .format = format_,
                                             .subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1}};
        samples::check(vkCreateImageView(device_.handle(), &viewInfo, nullptr, &views_.emplace_back()),
                       "vkCreateImageView");
        rendered_.push_back(makeSemaphore(device_.handle()));
    }
}

std::optional<uint32_t> Swapchain::acquire(uint32_t slot) {
    uint32_t image = 0;
    const VkResult result =
        vkAcquireNextImageKHR(device_.handle(), handle_, UINT64_MAX, acquired_[slot], VK_NULL_HANDLE, &image);
    if (result == VK_ERROR_OUT_OF_DATE_KHR) return std::nullopt;
    if (result != VK_SUBOPTIMAL_KHR) samples::check(result, "vkAcquireNextImageKHR");
    return image;   // a suboptimal one is shown, and replaced after present()
}

samples::WindowSync Swapchain::sync(uint32_t slot, uint32_t image) const {
    return {.acquired = acquired_[slot],
            .waitingStages = VK_PIPELINE_STAGE_TRANSFER_BIT,
            .rendered = rendered_[image]};
}

bool Swapchain::present(uint32_t image) {
    const VkPresentInfoKHR info{.sType = VK_STRUCTURE_TYPE_PRESENT_INFO_KHR,
                                .waitSemaphoreCount = 1,
                                .pWaitSemaphores = &rendered_[image],
                                .swapchainCount = 1,
                                .pSwapchains = &handle_,
                                .pImageIndices = &image};
    const VkResult result = vkQueuePresentKHR(device_.queue(), &info);
    if (result == VK_ERROR_OUT_OF_DATE_KHR || result == VK_SUBOPTIMAL_KHR) return false;
    samples::check(result, "vkQueuePresentKHR");
    return true;
}

}   // namespace viewer
