#include "viewer/overlay.h"

#include <vulkan/vulkan.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_vulkan.h>
#include <imgui.h>

namespace viewer {
namespace {

void setStyle(GLFWwindow* window) {
    float scale = 1, unused = 1;
    glfwGetWindowContentScale(window, &scale, &unused);
    ImGui::StyleColorsDark();
    ImGuiStyle& style = ImGui::GetStyle();
    style.WindowRounding = style.FrameRounding = style.GrabRounding = 3;
    style.WindowBorderSize = 0;
    style.Colors[ImGuiCol_WindowBg] = ImVec4(0.06f, 0.06f, 0.07f, 0.88f);
    style.ScaleAllSizes(scale);
    ImGui::GetIO().FontGlobalScale = scale;
    ImGui::GetIO().IniFilename = nullptr;   // leaves no file behind
}

}   // namespace

Overlay::Overlay(const samples::Device& device, const Window& window, const Swapchain& swapchain)
    : device_(device), swapchain_(swapchain) {
    makeRenderPass();
    const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1};   // the font
    const VkDescriptorPoolCreateInfo poolInfo{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                                              .flags = VK_DESCRIPTOR_POOL_CREATE_FREE_DESCRIPTOR_SET_BIT,
                                              .maxSets = 1,
                                              .poolSizeCount = 1,
                                              .pPoolSizes = &size};
    samples::check(vkCreateDescriptorPool(device.handle(), &poolInfo, nullptr, &pool_),
                   "vkCreateDescriptorPool");
    ImGui::CreateContext();
    setStyle(window.handle());
    ImGui_ImplGlfw_InitForVulkan(window.handle(), true);
    ImGui_ImplVulkan_InitInfo info{};
    info.Instance = device.instance();
    info.PhysicalDevice = device.physical();
    info.Device = device.handle();
    info.QueueFamily = device.queueFamily();
    info.Queue = device.queue();
    info.DescriptorPool = pool_;
    info.MinImageCount = info.ImageCount =
        samples::FrameSlots::kCount;   // of its buffers: one for each frame in flight
    info.CheckVkResultFn = [](VkResult result) { samples::check(result, "Dear ImGui"); };
    ImGui_ImplVulkan_Init(&info, renderPass_);
    device.submitAndWait([](VkCommandBuffer cmd) { ImGui_ImplVulkan_CreateFontsTexture(cmd); });
    ImGui_ImplVulkan_DestroyFontUploadObjects();
    resize();
}

Overlay::~Overlay() {
    device_.waitIdle();
    ImGui_ImplVulkan_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
    releaseTargets();
    vkDestroyDescriptorPool(device_.handle(), pool_, nullptr);
    vkDestroyRenderPass(device_.handle(), renderPass_, nullptr);
}

void Overlay::makeRenderPass() {
    const VkAttachmentDescription target{.format = swapchain_.format(),
                                         .samples = VK_SAMPLE_COUNT_1_BIT,
                                         .loadOp = VK_ATTACHMENT_LOAD_OP_LOAD,
                                         .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
                                         .stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE,
                                         .stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE,
                                         .initialLayout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                                         .finalLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR};
    const VkAttachmentReference reference{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    const VkSubpassDescription subpass{.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS,
                                       .colorAttachmentCount = 1,
                                       .pColorAttachments = &reference};
    const VkSubpassDependency behindCopy{
        .srcSubpass = VK_SUBPASS_EXTERNAL,
        .dstSubpass = 0,
        .srcStageMask = VK_PIPELINE_STAGE_TRANSFER_BIT,
        .dstStageMask = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT,
        .srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT,
        .dstAccessMask = VK_ACCESS_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT};
    const VkRenderPassCreateInfo info{.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO,
                                      .attachmentCount = 1,
                                      .pAttachments = &target,
                                      .subpassCount = 1,
                                      .pSubpasses = &subpass,
                                      .dependencyCount = 1,
                                      .pDependencies = &behindCopy};
    samples::check(vkCreateRenderPass(device_.handle(), &info, nullptr, &renderPass_), "vkCreateRenderPass");
}

void Overlay::releaseTargets() {
    for (VkFramebuffer target : targets_) vkDestroyFramebuffer(device_.handle(), target, nullptr);
    targets_.clear();
}

void Overlay::resize() {
    releaseTargets();
    for (uint32_t i = 0; i < swapchain_.count(); ++i) {
        const VkImageView view = swapchain_.view(i);
        const VkFramebufferCreateInfo info{.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO,
                                           .renderPass = renderPass_,
                                           .attachmentCount = 1,
                                           .pAttachments = &view,
                                           .width = swapchain_.extent().width,
                                           .height = swapchain_.extent().height,
                                           .layers = 1};
        samples::check(vkCreateFramebuffer(device_.handle(), &info, nullptr, &targets_.emplace_back()),
                       "vkCreateFramebuffer");
    }
}

void Overlay::begin() {
    ImGui_ImplVulkan_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
}

void Overlay::drop() { ImGui::EndFrame(); }

void Overlay::record(VkCommandBuffer cmd, uint32_t image) {
    ImGui::Render();
    const VkRenderPassBeginInfo info{.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO,
                                     .renderPass = renderPass_,
                                     .framebuffer = targets_[image],
                                     .renderArea = {{0, 0}, swapchain_.extent()}};
    vkCmdBeginRenderPass(cmd, &info, VK_SUBPASS_CONTENTS_INLINE);
    ImGui_ImplVulkan_RenderDrawData(ImGui::GetDrawData(), cmd);
    vkCmdEndRenderPass(cmd);
}

}   // namespace viewer
