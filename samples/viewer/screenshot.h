// Pictures from the GPU to files.
#pragma once

#include <string>

#include "viewer/picture.h"
#include "viewer/swapchain.h"

namespace viewer {

// What a picture shows, as .png, or its radiance, as .exr. Waits for the GPU. Throws std::runtime_error
// naming the file.
void savePicture(const samples::Device& device, Picture& picture, const std::string& path);

// The window with its panels: recorded into the frame that draws it, written when the GPU is done with that.
class WindowShot {
public:
    WindowShot(const samples::Device& device, const Swapchain& swapchain, std::string path);

    // The image is ready for being shown, before and after.
    void record(VkCommandBuffer cmd, VkImage image) const;
    void write() const;

private:
    std::string path_;
    VkExtent2D extent_;
    bool blueFirst_;
    samples::Buffer pixels_;
};

}   // namespace viewer
