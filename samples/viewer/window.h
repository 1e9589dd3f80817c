// A window of the desktop's, by GLFW.
#pragma once

#include <string>
#include <vector>

#include <vulkan/vulkan_core.h>

struct GLFWwindow;

namespace viewer {

class Window {
public:
    // Throws std::runtime_error saying what is missing: a display, or Vulkan on it.
    Window(VkExtent2D size, const char* title);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    GLFWwindow* handle() const { return handle_; }
    std::vector<const char*> instanceExtensions() const;
    VkSurfaceKHR makeSurface(VkInstance instance) const;

    // Handles what has happened; false: the window was closed. Waits while it has no pixels.
    bool poll();
    VkExtent2D extent() const;   // pixels
    void resize(VkExtent2D size);
    void setTitle(const std::string& title);
    bool isDown(int key) const;   // GLFW_KEY_*
    // Since the last call: keys that were pressed, files that were dropped on it.
    std::vector<int> takePressed();
    std::vector<std::string> takeDropped();

private:
    GLFWwindow* handle_ = nullptr;
    std::vector<int> pressed_;
    std::vector<std::string> dropped_;
};

}   // namespace viewer
