// shaders/values.glsl from C++.
#pragma once

#include <array>
#include <bit>

#include <glm/glm.hpp>

#include <restir/shared/frame.h>

#include "support/gpu.h"

namespace tests {

enum class Value : uint32_t { Packed, Reservoir, Projected, Surface, Faced, Light };

// 16 words, as the shader reads and writes them.
struct Record {
    std::array<uint32_t, 16> words{};

    float value(size_t i) const { return std::bit_cast<float>(words.at(i)); }
    glm::vec3 vector(size_t i) const { return {value(i), value(i + 1), value(i + 2)}; }
};

class RecordOf {
public:
    explicit RecordOf(Value what) { add(static_cast<uint32_t>(what)); }
    RecordOf& add(uint32_t word) {
        record_.words.at(used_++) = word;
        return *this;
    }
    RecordOf& add(float value) { return add(std::bit_cast<uint32_t>(value)); }
    RecordOf& add(glm::vec3 v) { return add(v.x).add(v.y).add(v.z); }
    operator Record() const { return record_; }

private:
    Record record_;
    size_t used_ = 0;
};

// One result for each record.
std::vector<Record> evaluate(const std::vector<Record>& records,
                             const std::vector<restir::gpu::RsView>& views = {});

}   // namespace tests
