#include "viewer/screenshot.h"

#include <array>
#include <stdexcept>

namespace viewer {
namespace {

constexpr samples::Access kCopyRead{VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_READ_BIT,
                                    VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL};
constexpr samples::Access kCopyWrite{VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT};
constexpr samples::Access kHost{VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT};

samples::Buffer makeReadback(const samples::Device& device, VkExtent2D extent, uint32_t texelBytes) {
    return samples::Buffer(device, {.size = VkDeviceSize{extent.width} * extent.height * texelBytes,
                                    .usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                    .memory = samples::MemoryKind::Readback});
}

// Of an image in kCopyRead.layout.
void copy(VkCommandBuffer cmd, VkImage image, VkExtent2D extent, const samples::Buffer& target) {
    const VkBufferImageCopy region{.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                                   .imageExtent = {extent.width, extent.height, 1}};
    vkCmdCopyImageToBuffer(cmd, image, kCopyRead.layout, target.handle(), 1, &region);
    samples::memoryBarrier(cmd, kCopyWrite, kHost);
}

samples::Buffer download(const samples::Device& device, const samples::GpuImage& image, VkImageLayout layout,
                         uint32_t texelBytes) {
    samples::Buffer pixels = makeReadback(device, image.extent(), texelBytes);
    device.waitIdle();
    device.submitAndWait([&](VkCommandBuffer cmd) {
        const samples::Access others{VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_MEMORY_WRITE_BIT,
                                     layout};
        samples::pipelineBarrier(cmd, {{samples::imageBarrier(image, others, kCopyRead)}});
        copy(cmd, image.handle(), image.extent(), pixels);
        samples::pipelineBarrier(cmd, {{samples::imageBarrier(image, kCopyRead, others)}});
    });
    return pixels;
}

// Bytes of four channels as floats of three.
samples::FloatImage fromBytes(const std::byte* bytes, VkExtent2D extent, bool blueFirst) {
    samples::FloatImage image{extent.width, extent.height, {}};
    const std::array<size_t, 3> order =
        blueFirst ? std::array<size_t, 3>{2, 1, 0} : std::array<size_t, 3>{0, 1, 2};
    for (size_t i = 0; i < size_t{extent.width} * extent.height; ++i)
        for (const size_t c : order) image.rgb.push_back(static_cast<float>(bytes[4 * i + c]) / 255);
    return image;
}

samples::FloatImage fromFloats(const std::byte* bytes, VkExtent2D extent) {
    samples::FloatImage image{extent.width, extent.height, {}};
    const auto* values = reinterpret_cast<const float*>(bytes);
    for (size_t i = 0; i < 4 * size_t{extent.width} * extent.height; ++i)
        if (i % 4 != 3) image.rgb.push_back(values[i]);
    return image;
}

}   // namespace

void savePicture(const samples::Device& device, Picture& picture, const std::string& path) {
    if (path.ends_with(".exr")) {
        const samples::Buffer pixels =
            download(device, picture.radiance(), VK_IMAGE_LAYOUT_GENERAL, 4 * sizeof(float));
        samples::writeExr(path, fromFloats(pixels.mapped(), picture.extent()));
    } else if (path.ends_with(".png")) {
        const samples::Buffer pixels =
            download(device, picture.display().image(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, 4);
        samples::writeColorsPng(path, fromBytes(pixels.mapped(), picture.extent(), false));
    } else {
        throw std::runtime_error(path + ": pictures are .png or .exr");
    }
}

WindowShot::WindowShot(const samples::Device& device, const Swapchain& swapchain, std::string path)
    : path_(std::move(path)),
      extent_(swapchain.extent()),
      blueFirst_(swapchain.format() == VK_FORMAT_B8G8R8A8_UNORM),
      pixels_(makeReadback(device, extent_, 4)) {
    if (!path_.ends_with(".png")) throw std::runtime_error(path_ + ": pictures of the window are .png");
    if (!swapchain.canBeRead())
        throw std::runtime_error(path_ + ": this display's windows cannot be read back");
}

void WindowShot::record(VkCommandBuffer cmd, VkImage image) const {
    const samples::Access drawn{VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
                                VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT, VK_IMAGE_LAYOUT_PRESENT_SRC_KHR};
    const samples::Access shown{VK_PIPELINE_STAGE_2_NONE, 0, VK_IMAGE_LAYOUT_PRESENT_SRC_KHR};
    samples::pipelineBarrier(cmd, {{samples::imageBarrier(image, drawn, kCopyRead)}});
    copy(cmd, image, extent_, pixels_);
    samples::pipelineBarrier(cmd, {{samples::imageBarrier(image, kCopyRead, shown)}});
}

void WindowShot::write() const {
    samples::writeColorsPng(path_, fromBytes(pixels_.mapped(), extent_, blueFirst_));
}

}   // namespace viewer
