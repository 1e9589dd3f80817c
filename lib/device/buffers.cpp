#include <device/buffers.h>

#include <utility>

namespace restir {
namespace {

constexpr MemoryUse kUses[] = {MemoryUse::DeviceOnly, MemoryUse::HostWrite, MemoryUse::HostRead};

VkBufferCreateInfo createInfo(const BufferRequest& request) noexcept {
    return {.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO, .size = request.size, .usage = request.usage};
}

VkMemoryRequirements requirements(const Device& device, const BufferRequest& request) noexcept {
    const VkBufferCreateInfo info = createInfo(request);
    const VkDeviceBufferMemoryRequirements query{.sType = VK_STRUCTURE_TYPE_DEVICE_BUFFER_MEMORY_REQUIREMENTS,
                                                 .pCreateInfo = &info};
    VkMemoryRequirements2 result{.sType = VK_STRUCTURE_TYPE_MEMORY_REQUIREMENTS_2};
    device.functions.vkGetDeviceBufferMemoryRequirements(device.info.device, &query, &result);
    return result.memoryRequirements;
}

// Where each buffer of one use lies in that use's block.
struct Layout {
    VkDeviceSize size = 0;
    uint32_t typeBits = ~0u;
    bool addressed = false;   // by shaders

    VkDeviceSize place(const VkMemoryRequirements& need) noexcept {
        const VkDeviceSize offset = (size + need.alignment - 1) / need.alignment * need.alignment;
        size = offset + need.size;
        typeBits &= need.memoryTypeBits;
        return offset;
    }
};

Layout layoutOf(const Device& device, std::span<const BufferRequest> requests, MemoryUse use) noexcept {
    Layout layout;
    for (const BufferRequest& request : requests)
        if (request.use == use) {
            layout.place(requirements(device, request));
            layout.addressed = layout.addressed || (request.usage & VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT) != 0;
        }
    return layout;
}

int memoryType(const Device& device, uint32_t typeBits, MemoryUse use) noexcept {
    const VkMemoryPropertyFlags host = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    const VkMemoryPropertyFlags required = use == MemoryUse::DeviceOnly ? VkMemoryPropertyFlags{0} : host;
    VkMemoryPropertyFlags preferred = required;
    if (use == MemoryUse::DeviceOnly) preferred |= VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
    if (use == MemoryUse::HostRead) preferred |= VK_MEMORY_PROPERTY_HOST_CACHED_BIT;
    for (VkMemoryPropertyFlags wanted : {preferred, required})
        for (uint32_t i = 0; i < device.memory.memoryTypeCount; ++i)
            if ((typeBits >> i & 1u) && (device.memory.memoryTypes[i].propertyFlags & wanted) == wanted) return int(i);
    return -1;
}

Error failureAt(const MessageSink& sink, const char* what, VkDeviceSize bytes, const char* name, VkResult vk) noexcept {
    report(sink, Severity::Error, "restir: %s: %llu bytes for %s (VkResult %d)", what,
           static_cast<unsigned long long>(bytes), name, int(vk));
    return {statusOf(vk, Status::DeviceError), vk, what};
}

}   // namespace

VkDeviceSize Buffers::memoryNeeded(const Device& device, std::span<const BufferRequest> requests) noexcept {
    VkDeviceSize sum = 0;
    if (device.info.memory.acquire) {   // places them itself
        for (const BufferRequest& request : requests) sum += request.size;
        return sum;
    }
    for (MemoryUse use : kUses) sum += layoutOf(device, requests, use).size;
    return sum;
}

Result<Buffers> Buffers::create(const Device& device, std::span<const BufferRequest> requests) noexcept {
    Buffers buffers;
    buffers.device_ = &device;
    buffers.grants_.resize(requests.size());
    if (auto done = buffers.allocate(requests); !done) return done.error();
    for (size_t i = 0; i < requests.size(); ++i)
        device.name(VK_OBJECT_TYPE_BUFFER, handleValue(buffers.grants_[i].buffer), requests[i].name);
    return buffers;
}

Result<bool> Buffers::allocate(std::span<const BufferRequest> requests) noexcept {
    const MemoryProvider& provider = device_->info.memory;
    if (provider.acquire) {
        for (size_t i = 0; i < requests.size(); ++i) {
            const VkResult vk = provider.acquire(provider.user, requests[i], grants_[i]);
            if (vk != VK_SUCCESS) grants_[i] = {};
            const bool mapped = requests[i].use == MemoryUse::DeviceOnly || grants_[i].mapped;
            if (vk == VK_SUCCESS && (!grants_[i].buffer || !mapped))
                return failure(device_->sink(), Status::InvalidArgument, "MemoryProvider::acquire gave no buffer or no mapping");
            if (vk != VK_SUCCESS)
                return failureAt(device_->sink(), "MemoryProvider::acquire failed", requests[i].size, requests[i].name, vk);
        }
        return true;
    }
    for (MemoryUse use : kUses)
        if (auto done = allocateBlock(requests, use); !done) return done;
    return true;
}

Result<bool> Buffers::allocateBlock(std::span<const BufferRequest> requests, MemoryUse use) noexcept {
    const Functions& f = device_->functions;
    const VkDevice device = device_->info.device;
    const Layout total = layoutOf(*device_, requests, use);
    if (total.size == 0) return true;
    const int type = memoryType(*device_, total.typeBits, use);
    const char* what = "allocating memory failed";
    const char* name = use == MemoryUse::DeviceOnly ? "the device" : "the host";
    if (type < 0) return failureAt(device_->sink(), what, total.size, name, VK_ERROR_OUT_OF_DEVICE_MEMORY);
    const VkMemoryAllocateFlagsInfo flags{.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO,
                                          .flags = VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT};
    const VkMemoryAllocateInfo allocateInfo{.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
                                            .pNext = total.addressed ? &flags : nullptr,
                                            .allocationSize = total.size,
                                            .memoryTypeIndex = uint32_t(type)};
    VkDeviceMemory& block = blocks_[size_t(use)];
    VkResult vk = orNull(f.vkAllocateMemory(device, &allocateInfo, device_->allocator(), &block), block);
    void* mapped = nullptr;
    if (vk == VK_SUCCESS && use != MemoryUse::DeviceOnly) vk = f.vkMapMemory(device, block, 0, VK_WHOLE_SIZE, 0, &mapped);
    if (vk != VK_SUCCESS) return failureAt(device_->sink(), what, total.size, name, vk);

    Layout placed;
    for (size_t i = 0; i < requests.size(); ++i) {
        if (requests[i].use != use) continue;
        const VkDeviceSize offset = placed.place(requirements(*device_, requests[i]));
        const VkBufferCreateInfo info = createInfo(requests[i]);
        VkBuffer& buffer = grants_[i].buffer;
        vk = orNull(f.vkCreateBuffer(device, &info, device_->allocator(), &buffer), buffer);
        if (vk == VK_SUCCESS) vk = f.vkBindBufferMemory(device, buffer, block, offset);
        if (vk != VK_SUCCESS)
            return failureAt(device_->sink(), "creating a buffer failed", requests[i].size, requests[i].name, vk);
        if (mapped) grants_[i].mapped = static_cast<uint8_t*>(mapped) + offset;
    }
    return true;
}

void Buffers::release() noexcept {
    if (!device_) return;
    const Functions& f = device_->functions;
    const MemoryProvider& provider = device_->info.memory;
    for (const BufferGrant& grant : grants_) {
        if (!grant.buffer) continue;
        if (provider.acquire) {
            if (provider.release) provider.release(provider.user, grant);
        } else {
            f.vkDestroyBuffer(device_->info.device, grant.buffer, device_->allocator());
        }
    }
    for (VkDeviceMemory block : blocks_)
        if (block) f.vkFreeMemory(device_->info.device, block, device_->allocator());
    grants_.clear();
    blocks_ = {};
    device_ = nullptr;
}

void Buffers::swap(Buffers& other) noexcept {
    std::swap(device_, other.device_);
    std::swap(grants_, other.grants_);
    std::swap(blocks_, other.blocks_);
}

}   // namespace restir
