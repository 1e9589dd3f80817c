// What LightTable's passes leave in its buffers.
#pragma once

#include <span>
#include <vector>

#include <restir/lights.h>
#include <restir/shared/lights.h>

namespace tests {

struct BuiltTable {
    std::vector<restir::gpu::RsPackedLight> lights;   // by id, as many as there are ids
    std::vector<restir::gpu::RsAliasEntry> alias;     // all columns that are drawn from
};

// Of a table for `maxLights`, or for as many as there are ids; `times` over again in one command buffer.
BuiltTable build(std::span<const restir::Light> lights, uint32_t maxLights = 0, uint32_t times = 1);

}   // namespace tests
