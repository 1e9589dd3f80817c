// Shapes and scenes in code, for the built-in scenes. Front faces wind counter-clockwise.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "scene.h"

namespace samples::build {

constexpr float kPi = 3.14159265f;

// A small hash-based generator: the same numbers on every compiler and machine.
class Rng {
public:
    explicit Rng(uint32_t seed) : state_(seed) {}
    uint32_t next();
    float uniform() { return static_cast<float>(next() >> 8) * 0x1p-24f; }   // [0, 1)
    float range(float lo, float hi) { return lo + (hi - lo) * uniform(); }
    uint32_t below(uint32_t count) { return next() % count; }
    glm::vec3 direction();

private:
    uint32_t state_;
};

// A parallelogram with edges `u` (right in the texture) and `v` (up), seen from the side of u x v.
struct Patch {
    glm::vec3 origin, u, v;
    uint32_t columns = 1, rows = 1;
    glm::vec2 uvScale{1}, uvOffset{0};
};
void addPatch(Geometry& out, const Patch& patch);

// Texture coordinates are metres from the box's corner.
void addBox(Geometry& out, const glm::vec3& lo, const glm::vec3& hi);
void addBox(Geometry& out, const glm::mat4& transform, const glm::vec3& lo, const glm::vec3& hi);

// Surface of revolution about +y through `centre`; `profile` holds (radius, height) from bottom to top.
void addLathe(Geometry& out, const glm::vec3& centre, std::span<const glm::vec2> profile, uint32_t sides);
void addSphere(Geometry& out, const glm::vec3& centre, const glm::vec3& radii, uint32_t slices,
               uint32_t stacks);
// A tube along a path, open at its ends.
void addTube(Geometry& out, std::span<const glm::vec3> path, float radius, uint32_t sides);
// 8 triangles with flat normals.
void addOctahedron(Geometry& out, const glm::vec3& centre, float radius);
void addTriangle(Geometry& out, const std::array<glm::vec3, 3>& corners);

// A wire from a to b that hangs `sag` below their middle.
std::vector<glm::vec3> hangingWire(const glm::vec3& a, const glm::vec3& b, float sag, uint32_t segments);

// Description of a material by what differs from a rough gray dielectric.
struct Surface {
    glm::vec3 color{0.5f};
    float roughness = 0.8f;
    float metalness = 0;
    glm::vec3 emission{0};
    float specular = 1;
    uint32_t colorTexture = RS_NO_TEXTURE;
    uint32_t roughnessTexture = RS_NO_TEXTURE;
    uint32_t normalTexture = RS_NO_TEXTURE;
    uint32_t emissionTexture = RS_NO_TEXTURE;
    bool doubleSided = false, alphaMask = false;
};

uint32_t addMaterial(SceneData& scene, const Surface& surface);
uint32_t addTexture(SceneData& scene, Image image);
// Drops geometries without triangles; kNoMesh where nothing is left, which addInstance ignores.
constexpr uint32_t kNoMesh = 0xffffffffu;
uint32_t addMesh(SceneData& scene, std::vector<Geometry> geometries);
void addInstance(SceneData& scene, uint32_t mesh, const glm::mat4& worldFromObject = glm::mat4{1});

glm::mat4 place(const glm::vec3& position, float turn = 0, float scale = 1);
// sRGB-encoded hexadecimal colour (0xrrggbb) to linear.
glm::vec3 hex(uint32_t rgb);

// Fills an image from a function of the pixel centre in [0, 1)^2, origin at the top left; colours are linear.
template <typename F>
Image paint(uint32_t width, uint32_t height, bool srgb, F&& colorAt);
uint8_t encodeByte(float linear, bool srgb);

template <typename F>
Image paint(uint32_t width, uint32_t height, bool srgb, F&& colorAt) {
    Image image{width, height, {}, srgb};
    image.rgba.reserve(size_t{width} * height * 4);
    for (uint32_t y = 0; y < height; ++y)
        for (uint32_t x = 0; x < width; ++x) {
            const glm::vec4 color = colorAt((glm::vec2(x, y) + 0.5f) / glm::vec2(width, height));
            for (int c = 0; c < 4; ++c) image.rgba.push_back(encodeByte(color[c], srgb && c < 3));
        }
    return image;
}

// Smooth noise in [0, 1], repeating every `period` units in both directions.
float noise(glm::vec2 p, uint32_t period, uint32_t seed);
// Four octaves of it, the first with `period` cells.
float fractalNoise(glm::vec2 uv, uint32_t period, uint32_t seed);
uint32_t hash(uint32_t value);

}   // namespace samples::build
