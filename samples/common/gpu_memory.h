// Buffers and images with an allocation each, and the way of bytes to and from them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/device.h"

namespace samples {

enum class MemoryKind : uint8_t { Gpu, Upload, Readback };   // the last two stay mapped

struct BufferDesc {
    VkDeviceSize size = 0;   // bytes; 0 makes a buffer of 16 bytes, so that every binding has one
    VkBufferUsageFlags usage = 0;
    MemoryKind memory = MemoryKind::Gpu;
};

class Buffer {
public:
    Buffer() = default;
    Buffer(const Device& device, const BufferDesc& desc);
    ~Buffer();
    Buffer(Buffer&& other) noexcept;
    Buffer& operator=(Buffer&& other) noexcept;

    VkBuffer handle() const { return buffer_; }
    VkDeviceSize size() const { return size_; }
    VkDeviceAddress address() const { return address_; }   // 0 without the usage flag
    std::byte* mapped() const { return mapped_; }          // null for MemoryKind::Gpu

private:
    void swap(Buffer& other) noexcept;

    const Device* device_ = nullptr;
    VkBuffer buffer_ = VK_NULL_HANDLE;
    VkDeviceMemory memory_ = VK_NULL_HANDLE;
    VkDeviceSize size_ = 0;
    VkDeviceAddress address_ = 0;
    std::byte* mapped_ = nullptr;
};

// A 2D image of one level and its view.
class GpuImage {
public:
    GpuImage() = default;
    GpuImage(const Device& device, VkExtent2D extent, VkFormat format, VkImageUsageFlags usage);
    ~GpuImage();
    GpuImage(GpuImage&& other) noexcept;
    GpuImage& operator=(GpuImage&& other) noexcept;

    VkImage handle() const { return image_; }
    VkImageView view() const { return view_; }
    VkExtent2D extent() const { return extent_; }

private:
    void swap(GpuImage& other) noexcept;

    const Device* device_ = nullptr;
    VkImage image_ = VK_NULL_HANDLE;
    VkDeviceMemory memory_ = VK_NULL_HANDLE;
    VkImageView view_ = VK_NULL_HANDLE;
    VkExtent2D extent_{};
};

struct Access {
    VkPipelineStageFlags2 stages = 0;
    VkAccessFlags2 access = 0;
    VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
};
VkImageMemoryBarrier2 imageBarrier(VkImage image, const Access& from, const Access& to);
VkImageMemoryBarrier2 imageBarrier(const GpuImage& image, const Access& from, const Access& to);
void pipelineBarrier(VkCommandBuffer cmd, std::span<const VkImageMemoryBarrier2> images);
// Everything written by `from` becomes visible to `to`; layouts are ignored.
void memoryBarrier(VkCommandBuffer cmd, const Access& from, const Access& to);

// Copies through one staging buffer, which is submitted whenever it is full and by flush().
class Uploader {
public:
    explicit Uploader(const Device& device);

    void buffer(const Buffer& target, VkDeviceSize offset, std::span<const std::byte> bytes);
    // The whole image, row by row. Leaves it in SHADER_READ_ONLY_OPTIMAL.
    void image(const GpuImage& target, std::span<const std::byte> texels);
    void flush();

private:
    struct BufferCopy {
        VkBuffer target;
        VkBufferCopy region;
    };

    const Device& device_;
    Buffer staging_;
    VkDeviceSize used_ = 0;
    std::vector<BufferCopy> copies_;
};

}   // namespace samples
