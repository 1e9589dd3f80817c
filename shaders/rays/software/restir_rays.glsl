// RayBackend::Software, bound.
layout(set = RS_SET, binding = RS_BIND_BVH_NODES, scalar) readonly buffer RsBvhNodes { uvec4 rsBvhNodes[]; };
layout(set = RS_SET, binding = RS_BIND_BVH_CORNERS, scalar) readonly buffer RsBvhCorners { uvec4 at[]; } rsBvhCorners[3];
layout(set = RS_SET, binding = RS_BIND_BVH_INSTANCES, scalar) readonly buffer RsBvhInstances { uvec4 rsBvhInstances[]; };
#include "restir/rays/software.glsl"

uvec4 rsLoadBvhNode(uint vector) { return rsBvhNodes[vector]; }
uint rsLoadBvhLink(uint vector) { return rsBvhNodes[vector].w; }
uvec4 rsLoadBvhCorner(uint corner, uint triangle) { return rsBvhCorners[corner].at[triangle]; }
uvec4 rsLoadBvhInstance(uint vector) { return rsBvhInstances[vector]; }
uint rsBvhRoot(bool previous) { return previous ? rsFrame.bvhPreviousRoot : rsFrame.bvhRoot; }
