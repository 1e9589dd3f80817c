// RayBackend::Pipeline, bound: a pass is a ray generation shader (RS_RAY_STAGE), the other stages are beside this file.
layout(set = RS_SET, binding = RS_BIND_TLAS) uniform accelerationStructureEXT rsTlas;
layout(set = RS_SET, binding = RS_BIND_PREVIOUS_TLAS) uniform accelerationStructureEXT rsPreviousTlas;
#include "restir/rays/pipeline.glsl"
