// RayBackend::RayQuery, bound.
#extension GL_EXT_ray_query : require
layout(set = RS_SET, binding = RS_BIND_TLAS) uniform accelerationStructureEXT rsTlas;
layout(set = RS_SET, binding = RS_BIND_PREVIOUS_TLAS) uniform accelerationStructureEXT rsPreviousTlas;
#include "restir/rays/query.glsl"
