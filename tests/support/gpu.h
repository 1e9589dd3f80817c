// Compute shaders over storage buffers, on a device that lives as long as the program.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "common/device.h"

namespace tests {

// Core and synchronization validation are on.
samples::Device& gpu();

// A storage buffer of one run: a copy of `bytes`, which come back afterwards if `returned`.
struct Argument {
    std::span<std::byte> bytes;
    bool returned = false;
};
template <class T>
Argument in(const std::vector<T>& values) {
    return {std::as_writable_bytes(std::span(const_cast<T*>(values.data()), values.size())), false};
}
template <class T>
Argument out(std::vector<T>& values) {
    return {std::as_writable_bytes(std::span(values)), true};
}

// One shader: argument i is binding i of set 0. No push constants.
class Kernel {
public:
    explicit Kernel(std::span<const uint32_t> spirv, uint32_t argumentCount);
    ~Kernel();
    Kernel(const Kernel&) = delete;
    Kernel& operator=(const Kernel&) = delete;

    void run(uint32_t groups, std::initializer_list<Argument> arguments) const;

private:
    void makeLayouts(uint32_t argumentCount);

    VkDescriptorSetLayout setLayout_ = VK_NULL_HANDLE;
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
    VkPipeline pipeline_ = VK_NULL_HANDLE;
    VkDescriptorPool pool_ = VK_NULL_HANDLE;
    VkDescriptorSet set_ = VK_NULL_HANDLE;
};

// Fails a test during which the validation layer said something.
class GpuTest : public ::testing::Test {
protected:
    void SetUp() override { messages_ = gpu().validationMessages(); }
    void TearDown() override {
        EXPECT_EQ(gpu().validationMessages(), messages_) << "validation messages, see stderr";
    }

private:
    uint32_t messages_ = 0;
};

}   // namespace tests
