#pragma once

#include <cstdio>

#include <restir/device.h>

namespace restir {

// One formatted line to the host's sink.
template <class... Args>
void report(const MessageSink& sink, Severity severity, const char* format, Args... args) noexcept {
    if (!sink.report) return;
    char text[512];
#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wformat-security"
#pragma GCC diagnostic ignored "-Wformat-nonliteral"
#endif
    std::snprintf(text, sizeof text, format, args...);
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif
    sink.report(sink.user, severity, text);
}

template <class... Args>
Status refuse(const MessageSink& sink, const char* format, Args... args) noexcept {
    report(sink, Severity::Error, format, args...);
    return Status::InvalidArgument;
}

inline Status statusOf(VkResult vk, Status other) noexcept {
    if (vk == VK_ERROR_OUT_OF_HOST_MEMORY) return Status::OutOfHostMemory;
    return vk == VK_ERROR_OUT_OF_DEVICE_MEMORY ? Status::OutOfDeviceMemory : other;
}

// An error whose long form is the same as its short one.
inline Error failure(const MessageSink& sink, Status status, const char* what, VkResult vk = VK_SUCCESS) noexcept {
    status = statusOf(vk, status);
    if (vk == VK_SUCCESS) report(sink, Severity::Error, "restir: %s", what);
    else report(sink, Severity::Error, "restir: %s (VkResult %d)", what, int(vk));
    return {status, vk, what};
}

}   // namespace restir
