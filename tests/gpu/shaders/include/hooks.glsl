// What the library asks its includer for, where a test has nothing to say.
#include "restir/shared/lights.h"
vec4 rsBridgeTexture(uint index, vec2 uv) { return vec4(uv, 0.5, 1.0); }
uint rsInfiniteLight(uint i) { return 0xffffffffu; }
#ifndef HOOKS_ENVIRONMENT
uvec2 rsEnvironmentExtent() { return uvec2(1u); }
RsEnvironmentTexel rsLoadEnvironment(uint index) { return RsEnvironmentTexel(0xffffffffu, 0u, 1.0); }
#endif
#ifndef HOOKS_TREE
uvec4 rsLoadTreeNode(uint node) { return uvec4(0u); }
uint rsLoadTreeWord(uint index) { return 0u; }
#endif
