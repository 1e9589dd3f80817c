// Names that mean the same in C++ and GLSL. Every shared struct is read with GLSL scalar layout, so the C++
// structs below match it without padding fields.
#ifndef RESTIR_SHARED_TYPES_H
#define RESTIR_SHARED_TYPES_H
#ifdef __cplusplus
#include <cstdint>
namespace restir::gpu {   // NOLINTBEGIN(readability-identifier-naming): GLSL spelling
using uint = uint32_t;
using RsAddress = uint64_t;   // VkDeviceAddress
struct vec2 { float x = 0, y = 0; };
struct vec3 { float x = 0, y = 0, z = 0; };
struct vec4 { float x = 0, y = 0, z = 0, w = 0; };
struct uvec2 { uint x = 0, y = 0; };
struct uvec4 { uint x = 0, y = 0, z = 0, w = 0; };
// NOLINTEND(readability-identifier-naming)
}   // namespace restir::gpu
#define RS_SHARED_BEGIN namespace restir::gpu {
#define RS_SHARED_END }
#else
#define RsAddress uvec2
#define RS_SHARED_BEGIN
#define RS_SHARED_END
#endif
#endif
