// Dear ImGui over the window's picture.
#pragma once

#include <vector>

#include "viewer/swapchain.h"
#include "viewer/window.h"

namespace viewer {

class Overlay {
public:
    Overlay(const samples::Device& device, const Window& window, const Swapchain& swapchain);
    ~Overlay();
    Overlay(const Overlay&) = delete;
    Overlay& operator=(const Overlay&) = delete;

    // After Swapchain::resize().
    void resize();

    // Between begin() and record() the panels are declared; every begin() is followed by record() or drop().
    void begin();
    void drop();
    // Draws them over what is there. The image comes in TRANSFER_DST_OPTIMAL, written by a transfer, and goes
    // ready for being shown.
    void record(VkCommandBuffer cmd, uint32_t image);

private:
    void makeRenderPass();
    void releaseTargets();

    const samples::Device& device_;
    const Swapchain& swapchain_;
    VkRenderPass renderPass_ = VK_NULL_HANDLE;
    VkDescriptorPool pool_ = VK_NULL_HANDLE;
    std::vector<VkFramebuffer> targets_;
};

}   // namespace viewer
