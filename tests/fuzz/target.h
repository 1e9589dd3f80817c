// What is fed with any bytes at all: a crash, a leak, undefined behaviour or an exception is a mistake.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace fuzz {

using Bytes = std::vector<uint8_t>;

struct Target {
    const char* name;
    void (*run)(std::span<const uint8_t> bytes);
    std::vector<Bytes> (*seeds)();   // to start from
};

extern const Target kFrame, kLights, kGltf;

}   // namespace fuzz
