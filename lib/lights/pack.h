// A host's lights, checked and packed.
#pragma once

#include <span>
#include <vector>

#include <device/messages.h>
#include <restir/lights.h>
#include <restir/shared/lights.h>

namespace restir {

struct PackedLights {
    std::vector<gpu::RsPackedLight> lights;   // by id; RS_LIGHT_NONE in the gaps
    std::vector<gpu::RsAliasEntry> alias;     // one column per id; empty if nothing shines
    uint32_t textures = 0;                    // one more than the largest index
};

struct LightLimits {
    uint32_t lights = 0;     // ids are below
    uint32_t textures = 0;   // so are texture indices
};

// Names the light and the field if one is bad, and leaves `packed` alone.
Status packLights(const MessageSink& sink, const LightLimits& limits, std::span<const Light> lights, PackedLights& packed);

}   // namespace restir
