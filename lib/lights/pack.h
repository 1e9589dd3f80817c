// A host's lights, checked and packed in one go.
#pragma once

#include <span>
#include <vector>

#include <device/messages.h>
#include <restir/lights.h>
#include <restir/shared/lights.h>
#include <restir/shared/scene.h>

namespace restir {

struct LightLimits {
    uint32_t first = 0;      // ids are from here on
    uint32_t lights = 0;     // and below
    uint32_t textures = 0;   // so are texture indices
    double environment = -1; // luminance of the map, integrated over the sphere; negative: there is none
};

struct PackedLights {
    uint32_t count = 0;         // one more than the largest id
    uint32_t textures = 0;      // one more than the largest texture index
    bool infinite = false;      // there is a light whose power depends on where the others are
    uint32_t found[RS_INFINITE_LIGHTS] = {RS_NO_LIGHT, RS_NO_LIGHT, RS_NO_LIGHT, RS_NO_LIGHT};   // RsFrame::infiniteLights
};

class LightPacker {
public:
    explicit LightPacker(const LightLimits& limits) : limits_(limits), seen_((size_t{limits.lights} + 63) / 64) {}

    // Writes the lights to `out` by id, the first there being LightLimits::first, RS_LIGHT_NONE into the gaps, and what is said of them to `packed`.
    // RsPackedLight::selection holds what restir/lights/power.glsl takes for the mean luminance of the emission. Names the
    // light and the field if one is bad; `packed` is then as before, `out` is not. Only checks if `out` is null.
    Status pack(const MessageSink& sink, std::span<const Light> lights, gpu::RsPackedLight* out, PackedLights& packed);

    void environmentHas(double luminance) { limits_.environment = luminance; }

private:
    LightLimits limits_;
    std::vector<uint64_t> seen_;   // ids, a bit each
};

}   // namespace restir
