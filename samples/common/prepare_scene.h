#pragma once

#include "common/scene.h"

namespace samples {

// Puts a scene into the form the GPU takes: triangles in spatial order (their order is part of the geometry:
// light ids follow it), empty geometries and meshes without instances gone, emission of masked materials
// baked. A mirrored instance of a one-sided emitter gets a mesh of its own with the corners in the other
// order, so that counter-clockwise in world space is the emitting side everywhere.
void prepareScene(SceneData& scene);

}   // namespace samples
