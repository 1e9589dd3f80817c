// An instance as rays meet it: its inverse transform and its box in the world.
#pragma once

#include <rays/tree.h>
#include <restir/bvh.h>

namespace restir {

// False: it is flat, or beyond the numbers that rays are followed in, and nothing can be hit of it.
bool placeInstance(const BvhInstance& instance, const Box& mesh, gpu::RsBvhInstance& placed,
                   Box& world) noexcept;

}   // namespace restir
