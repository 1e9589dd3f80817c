// Scenes in which the mistakes of tests/mutants show, with what they must look like in closed form.
#pragma once

#include <memory>

#include <common/gpu_scene.h>

#include "image/host_view.h"

namespace tests {

class Play {
public:
    static constexpr VkExtent2D kExtent{32, 32};

    virtual ~Play() = default;
    virtual void setUp(HostView& host, uint32_t frame, uint32_t frames) const = 0;   // lights and camera
    virtual samples::FloatImage truth() const = 0;                                   // of the last frame

    std::unique_ptr<samples::GpuScene> scene;
    samples::View view;   // of the last frame
};

enum class Stage : uint8_t {
    Shadows,       // two lamps of different colours, each hidden from another part of a plane
    NearShadows,   // the same with lamps that directions find often
    Changes,       // moving camera, changing lights, no blocker
    Ball,          // a sphere and a rectangle close to a plane, drawn by solid angle
    Card,          // a standing card reflects light onto the plane: indirect light of two scatterings
};
// Made once.
const Play& play(Stage stage);

}   // namespace tests
