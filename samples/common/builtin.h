// The built-in scenes, one file each. All are deterministic.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "scene.h"

namespace samples::build {

// A closed room with two boxes, lit by 100 small coloured triangles that float in it.
SceneData makeCornell();

// A dark room and a bright one with a door between them, which moves; and the lamp of the bright one goes on and off.
SceneData makeRooms();

// A market street at night: lit windows, signs, lanterns, lamps and strings of bulbs over wet cobbles.
SceneData makeMarket();

// A square kilometre of towers at night: 1,040,384 emissive triangles.
SceneData makeCity();

// The scale of a large game level, by default Bistro exterior's.
struct StreetSize {
    uint64_t triangles = 2826672, emissive = 20658;   // exact, instances counted
};
SceneData makeStreet(const StreetSize& size);

// A few boxes under lamps of one kind, or under one of each: "triangle", "sphere" ..., "all". Throws
// std::runtime_error that names them all.
SceneData makeLamps(std::string_view kind);
std::span<const std::string_view> lampKinds();

}   // namespace samples::build
