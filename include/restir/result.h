#pragma once

#include <cassert>
#include <cstdint>
#include <utility>
#include <variant>

#include <vulkan/vulkan_core.h>

namespace restir {

enum class Status : uint8_t {
    Ok,
    InvalidArgument,   // the message sink names the field and the value
    MissingFeature,    // the device, or its loader, lacks something deviceNeeds() lists
    ShaderMismatch,    // a ShaderPack for another RESTIR_SHADER_ABI or RayBackend, or without a pass
    OutOfHostMemory,
    OutOfDeviceMemory,
    DeviceError,   // Error::vk says which
};

struct Error {
    Status status = Status::Ok;
    VkResult vk = VK_SUCCESS;
    const char* what = "";   // static text, never freed; the message sink gets the long form
};

// A value or the reason there is none. Nothing in the SDK throws.
template <class T>
class [[nodiscard]] Result {
public:
    Result(T value) noexcept : state_(std::move(value)) {}
    Result(Error error) noexcept : state_(error) {}

    explicit operator bool() const noexcept { return state_.index() == 0; }
    const Error& error() const noexcept {
        assert(!*this);
        return *std::get_if<1>(&state_);
    }

    T& operator*() & noexcept {
        assert(*this);
        return *std::get_if<0>(&state_);
    }
    T&& operator*() && noexcept {
        assert(*this);
        return std::move(*std::get_if<0>(&state_));
    }
    const T& operator*() const& noexcept {
        assert(*this);
        return *std::get_if<0>(&state_);
    }
    T* operator->() noexcept { return &**this; }
    const T* operator->() const noexcept { return &**this; }

private:
    std::variant<T, Error> state_;
};

}   // namespace restir
