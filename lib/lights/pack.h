// A host's lights, checked and packed.
#pragma once

#include <span>
#include <vector>

#include <device/messages.h>
#include <restir/lights.h>
#include <restir/shared/lights.h>

namespace restir {

struct PackedLights {
    std::vector<gpu::RsPackedLight> lights;   // by id; one RS_LIGHT_NONE past the last
    std::vector<gpu::RsAliasEntry> alias;     // one column per id; empty if nothing shines
};

// Names the light and the field if one is bad, and leaves `packed` alone.
Status packLights(const MessageSink& sink, uint32_t maxLights, std::span<const Light> lights, PackedLights& packed);

}   // namespace restir
