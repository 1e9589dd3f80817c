#include "common/gpu_memory.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace samples {
namespace {

constexpr VkDeviceSize kStagingBytes = 64u << 20;

VkMemoryPropertyFlags wanted(MemoryKind kind) {
    if (kind == MemoryKind::Gpu) return VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
    const VkMemoryPropertyFlags mapped =
        VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    return kind == MemoryKind::Readback ? mapped | VK_MEMORY_PROPERTY_HOST_CACHED_BIT : mapped;
}

uint32_t findMemoryType(const Device& device, uint32_t allowed, MemoryKind kind) {
    VkPhysicalDeviceMemoryProperties memory;
    vkGetPhysicalDeviceMemoryProperties(device.physical(), &memory);
    const VkMemoryPropertyFlags cached = VK_MEMORY_PROPERTY_HOST_CACHED_BIT;
    for (VkMemoryPropertyFlags flags : {wanted(kind), wanted(kind) & ~cached}) {   // second choice: uncached
        for (uint32_t i = 0; i < memory.memoryTypeCount; ++i) {
            const bool fits = (memory.memoryTypes[i].propertyFlags & flags) == flags;
            if ((allowed >> i & 1u) && fits) return i;
        }
    }
    throw std::runtime_error("the device has no memory type for a resource");
}

VkDeviceMemory allocate(const Device& device, const VkMemoryRequirements& needs, MemoryKind kind,
                        bool addressed) {
    const VkMemoryAllocateFlagsInfo flags{.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO,
                                          .flags = VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT};
    const VkMemoryAllocateInfo info{.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
                                    .pNext = addressed ? &flags : nullptr,
                                    .allocationSize = needs.size,
                                    .memoryTypeIndex = findMemoryType(device, needs.memoryTypeBits, kind)};
    VkDeviceMemory memory = VK_NULL_HANDLE;
    check(vkAllocateMemory(device.handle(), &info, nullptr, &memory), "vkAllocateMemory");
    return memory;
}

}   // namespace

Buffer::Buffer(const Device& device, const BufferDesc& desc)
    : device_(&device), size_(std::max<VkDeviceSize>(desc.size, 16)) {
    const VkBufferCreateInfo info{
        .sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO, .size = size_, .usage = desc.usage};
    check(vkCreateBuffer(device.handle(), &info, nullptr, &buffer_), "vkCreateBuffer");
    VkMemoryRequirements needs;
    vkGetBufferMemoryRequirements(device.handle(), buffer_, &needs);
    const bool addressed = (desc.usage & VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT) != 0;
    memory_ = allocate(device, needs, desc.memory, addressed);
    check(vkBindBufferMemory(device.handle(), buffer_, memory_, 0), "vkBindBufferMemory");
    if (desc.memory != MemoryKind::Gpu) {
        void* pointer = nullptr;
        check(vkMapMemory(device.handle(), memory_, 0, VK_WHOLE_SIZE, 0, &pointer), "vkMapMemory");
        mapped_ = static_cast<std::byte*>(pointer);
    }
    if (addressed) {
        const VkBufferDeviceAddressInfo addressInfo{.sType = VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO,
                                                    .buffer = buffer_};
        address_ = vkGetBufferDeviceAddress(device.handle(), &addressInfo);
    }
}

Buffer::~Buffer() {
    if (device_ == nullptr) return;
    vkDestroyBuffer(device_->handle(), buffer_, nullptr);
    vkFreeMemory(device_->handle(), memory_, nullptr);
}

Buffer::Buffer(Buffer&& other) noexcept { swap(other); }

Buffer& Buffer::operator=(Buffer&& other) noexcept {
    swap(other);
    return *this;
}

void Buffer::swap(Buffer& other) noexcept {
    std::swap(device_, other.device_);
    std::swap(buffer_, other.buffer_);
    std::swap(memory_, other.memory_);
    std::swap(size_, other.size_);
    std::swap(address_, other.address_);
    std::swap(mapped_, other.mapped_);
}

GpuImage::GpuImage(const Device& device, VkExtent2D extent, VkFormat format, VkImageUsageFlags usage)
    : device_(&device), extent_(extent) {
    const VkImageCreateInfo info{.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
                                 .imageType = VK_IMAGE_TYPE_2D,
                                 .format = format,
                                 .extent = {extent.width, extent.height, 1},
                                 .mipLevels = 1,
                                 .arrayLayers = 1,
                                 .samples = VK_SAMPLE_COUNT_1_BIT,
                                 .tiling = VK_IMAGE_TILING_OPTIMAL,
                                 .usage = usage};
    check(vkCreateImage(device.handle(), &info, nullptr, &image_), "vkCreateImage");
    VkMemoryRequirements needs;
    vkGetImageMemoryRequirements(device.handle(), image_, &needs);
    memory_ = allocate(device, needs, MemoryKind::Gpu, false);
    check(vkBindImageMemory(device.handle(), image_, memory_, 0), "vkBindImageMemory");
    const VkImageViewCreateInfo viewInfo{.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
                                         .image = image_,
                                         .viewType = VK_IMAGE_VIEW_TYPE_2D,
                                         .format = format,
                                         .subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1}};
    check(vkCreateImageView(device.handle(), &viewInfo, nullptr, &view_), "vkCreateImageView");
}

GpuImage::~GpuImage() {
    if (device_ == nullptr) return;
    vkDestroyImageView(device_->handle(), view_, nullptr);
    vkDestroyImage(device_->handle(), image_, nullptr);
    vkFreeMemory(device_->handle(), memory_, nullptr);
}

GpuImage::GpuImage(GpuImage&& other) noexcept { swap(other); }

GpuImage& GpuImage::operator=(GpuImage&& other) noexcept {
    swap(other);
    return *this;
}

void GpuImage::swap(GpuImage& other) noexcept {
    std::swap(device_, other.device_);
    std::swap(image_, other.image_);
    std::swap(memory_, other.memory_);
    std::swap(view_, other.view_);
    std::swap(extent_, other.extent_);
}

VkImageMemoryBarrier2 imageBarrier(const GpuImage& image, const Access& from, const Access& to) {
    return imageBarrier(image.handle(), from, to);
}

VkImageMemoryBarrier2 imageBarrier(VkImage image, const Access& from, const Access& to) {
    return {.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2,
            .srcStageMask = from.stages,
            .srcAccessMask = from.access,
            .dstStageMask = to.stages,
            .dstAccessMask = to.access,
            .oldLayout = from.layout,
            .newLayout = to.layout,
            .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
            .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
            .image = image,
            .subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1}};
}

void pipelineBarrier(VkCommandBuffer cmd, std::span<const VkImageMemoryBarrier2> images) {
    const VkDependencyInfo info{.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
                                .imageMemoryBarrierCount = static_cast<uint32_t>(images.size()),
                                .pImageMemoryBarriers = images.data()};
    vkCmdPipelineBarrier2(cmd, &info);
}

void memoryBarrier(VkCommandBuffer cmd, const Access& from, const Access& to) {
    const VkMemoryBarrier2 barrier{.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2,
                                   .srcStageMask = from.stages,
                                   .srcAccessMask = from.access,
                                   .dstStageMask = to.stages,
                                   .dstAccessMask = to.access};
    const VkDependencyInfo info{
        .sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO, .memoryBarrierCount = 1, .pMemoryBarriers = &barrier};
    vkCmdPipelineBarrier2(cmd, &info);
}

Uploader::Uploader(const Device& device)
    : device_(device),
      staging_(
          device,
          {.size = kStagingBytes, .usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT, .memory = MemoryKind::Upload}) {}

void Uploader::buffer(const Buffer& target, VkDeviceSize offset, std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        if (used_ == kStagingBytes) flush();
        const VkDeviceSize count = std::min<VkDeviceSize>(bytes.size(), kStagingBytes - used_);
        std::memcpy(staging_.mapped() + used_, bytes.data(), count);
        copies_.push_back({target.handle(), {.srcOffset = used_, .dstOffset = offset, .size = count}});
        used_ += count;
        offset += count;
        bytes = bytes.subspan(count);
    }
}

void Uploader::image(const GpuImage& target, std::span<const std::byte> texels) {
    flush();
    const VkExtent2D extent = target.extent();
    const VkDeviceSize rowBytes = texels.size() / extent.height;
    const auto bandRows = static_cast<uint32_t>(kStagingBytes / rowBytes);
    const Access nothing{};
    const Access copy{VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                      VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL};
    const Access shader{VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT,
                        VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
    for (uint32_t row = 0; row < extent.height; row += bandRows) {
        const uint32_t rows = std::min(bandRows, extent.height - row);
        std::memcpy(staging_.mapped(), texels.data() + row * rowBytes, rows * rowBytes);
        device_.submitAndWait([&](VkCommandBuffer cmd) {
            if (row == 0) pipelineBarrier(cmd, {{imageBarrier(target, nothing, copy)}});
            const VkBufferImageCopy region{.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                                           .imageOffset = {0, static_cast<int32_t>(row), 0},
                                           .imageExtent = {extent.width, rows, 1}};
            vkCmdCopyBufferToImage(cmd, staging_.handle(), target.handle(),
                                   VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
            if (row + rows == extent.height) pipelineBarrier(cmd, {{imageBarrier(target, copy, shader)}});
        });
    }
}

void Uploader::flush() {
    if (copies_.empty()) return;
    device_.submitAndWait([&](VkCommandBuffer cmd) {
        for (const BufferCopy& copy : copies_) {
            vkCmdCopyBuffer(cmd, staging_.handle(), copy.target, 1, &copy.region);
        }
    });
    copies_.clear();
    used_ = 0;
}

}   // namespace samples
