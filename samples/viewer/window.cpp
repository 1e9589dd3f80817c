#include "viewer/window.h"

#include <stdexcept>
#include <utility>

#define GLFW_INCLUDE_NONE
#include <vulkan/vulkan.h>

#include <GLFW/glfw3.h>

#include "common/device.h"

namespace viewer {
namespace {

[[noreturn]] void fail(const char* what) {
    const char* reason = nullptr;
    glfwGetError(&reason);
    throw std::runtime_error(std::string(what) + (reason ? std::string(" (GLFW: ") + reason + ")" : ""));
}

}   // namespace

Window::Window(VkExtent2D size, const char* title) {
    if (!glfwInit())
        fail(
            "there is no display to open a window on; without a screen:\n"
            "    xvfb-run -s '-screen 0 1600x900x24' restir-viewer SCENE\n"
            "or render pictures with restir-render");
    if (!glfwVulkanSupported()) {
        glfwTerminate();
        throw std::runtime_error(
            "GLFW finds no Vulkan that can draw to this display: no loader, no driver, or a driver without "
            "VK_KHR_surface for it");
    }
    glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
    handle_ = glfwCreateWindow(static_cast<int>(size.width), static_cast<int>(size.height), title, nullptr,
                               nullptr);
    if (!handle_) {
        glfwTerminate();
        fail("the window cannot be opened");
    }
    glfwSetWindowUserPointer(handle_, this);
    glfwSetKeyCallback(handle_, [](GLFWwindow* window, int key, int, int action, int) {
        if (action == GLFW_PRESS)
            static_cast<Window*>(glfwGetWindowUserPointer(window))->pressed_.push_back(key);
    });
    glfwSetDropCallback(handle_, [](GLFWwindow* window, int count, const char** paths) {
        auto& dropped = static_cast<Window*>(glfwGetWindowUserPointer(window))->dropped_;
        dropped.insert(dropped.end(), paths, paths + count);
    });
}

Window::~Window() {
    glfwDestroyWindow(handle_);
    glfwTerminate();
}

std::vector<const char*> Window::instanceExtensions() const {
    uint32_t count = 0;
    const char** names = glfwGetRequiredInstanceExtensions(&count);
    if (!names) fail("GLFW cannot make Vulkan surfaces on this display");
    return {names, names + count};
}

VkSurfaceKHR Window::makeSurface(VkInstance instance) const {
    VkSurfaceKHR surface = VK_NULL_HANDLE;
    samples::check(glfwCreateWindowSurface(instance, handle_, nullptr, &surface), "glfwCreateWindowSurface");
    return surface;
}

bool Window::poll() {
    glfwPollEvents();
    while (!glfwWindowShouldClose(handle_) && (extent().width == 0 || extent().height == 0)) glfwWaitEvents();
    return !glfwWindowShouldClose(handle_);
}

VkExtent2D Window::extent() const {
    int width = 0, height = 0;
    glfwGetFramebufferSize(handle_, &width, &height);
    return {static_cast<uint32_t>(width), static_cast<uint32_t>(height)};
}

void Window::resize(VkExtent2D size) {
    glfwSetWindowSize(handle_, static_cast<int>(size.width), static_cast<int>(size.height));
}

void Window::setTitle(const std::string& title) { glfwSetWindowTitle(handle_, title.c_str()); }

bool Window::isDown(int key) const { return glfwGetKey(handle_, key) == GLFW_PRESS; }

std::vector<int> Window::takePressed() { return std::exchange(pressed_, {}); }

std::vector<std::string> Window::takeDropped() { return std::exchange(dropped_, {}); }

}   // namespace viewer
