// The pictures that a window shows in turn.
#pragma once

#include <optional>
#include <vector>

#include "common/device.h"

namespace viewer {

class Swapchain {
public:
    // Of a Device with a surface. Throws std::runtime_error where the surface cannot be written as the viewer
    // does.
    explicit Swapchain(const samples::Device& device);
    ~Swapchain();
    Swapchain(const Swapchain&) = delete;
    Swapchain& operator=(const Swapchain&) = delete;

    // Makes its images anew, for a window of that size. The GPU is done with them.
    void resize(VkExtent2D window);

    // An image to draw, or nothing: resize() first. The GPU is done with the frame slot's last use.
    std::optional<uint32_t> acquire(uint32_t slot);
    // For the submission that draws it.
    samples::WindowSync sync(uint32_t slot, uint32_t image) const;
    // False: resize() before the next.
    bool present(uint32_t image);

    VkFormat format() const { return format_; }
    VkExtent2D extent() const { return extent_; }
    VkImage image(uint32_t index) const { return images_[index]; }
    VkImageView view(uint32_t index) const { return views_[index]; }
    uint32_t count() const { return static_cast<uint32_t>(images_.size()); }
    bool canBeRead() const { return (usage_ & VK_IMAGE_USAGE_TRANSFER_SRC_BIT) != 0; }

private:
    void chooseFormat();
    void releaseImages();

    const samples::Device& device_;
    VkFormat format_ = VK_FORMAT_UNDEFINED;
    VkColorSpaceKHR colors_ = VK_COLOR_SPACE_SRGB_NONLINEAR_KHR;
    VkImageUsageFlags usage_ = 0;
    VkExtent2D extent_{};
    VkSwapchainKHR handle_ = VK_NULL_HANDLE;
    std::vector<VkImage> images_;
    std::vector<VkImageView> views_;
    std::vector<VkSemaphore> rendered_;   // by image: the presentation waits for it
    VkSemaphore acquired_[samples::FrameSlots::kCount] = {};
};

}   // namespace viewer
