#include "mesh_builder.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

namespace samples::build {

namespace {

uint32_t vertexCount(const Geometry& geometry) { return static_cast<uint32_t>(geometry.positions.size()); }

void addVertex(Geometry& out, const glm::vec3& position, const glm::vec3& normal, const glm::vec2& uv) {
    out.positions.push_back(position);
    out.normals.push_back(normal);
    out.uvs.push_back(uv);
}

// Triangles of a grid of (columns + 1) x (rows + 1) vertices stored row by row, bottom row first.
void addGridIndices(Geometry& out, uint32_t first, uint32_t columns, uint32_t rows) {
    const uint32_t pitch = columns + 1;
    for (uint32_t row = 0; row < rows; ++row)
        for (uint32_t column = 0; column < columns; ++column) {
            const uint32_t a = first + row * pitch + column, b = a + 1, c = a + pitch, d = c + 1;
            out.indices.insert(out.indices.end(), {a, b, d, a, d, c});
        }
}

void transformFrom(Geometry& out, size_t firstVertex, const glm::mat4& transform) {
    const glm::mat3 normalTransform = glm::transpose(glm::inverse(glm::mat3{transform}));
    for (size_t i = firstVertex; i < out.positions.size(); ++i) {
        out.positions[i] = glm::vec3{transform * glm::vec4{out.positions[i], 1}};
        out.normals[i] = glm::normalize(normalTransform * out.normals[i]);
    }
}

// Outward in the (radius, height) plane, from the profile's neighbouring points.
glm::vec2 profileNormal(std::span<const glm::vec2> profile, size_t i) {
    const glm::vec2 before = profile[i > 0 ? i - 1 : i], after = profile[std::min(i + 1, profile.size() - 1)];
    const glm::vec2 along = after - before;
    const float length = glm::length(along);
    return length > 0 ? glm::vec2{along.y, -along.x} / length : glm::vec2{1, 0};
}

}   // namespace

uint32_t hash(uint32_t value) {
    value ^= value >> 16;
    value *= 0x7feb352du;
    value ^= value >> 15;
    value *= 0x846ca68bu;
    return value ^ (value >> 16);
}

uint32_t Rng::next() {
    state_ += 0x9e3779b9u;
    return hash(state_);
}

glm::vec3 Rng::direction() {
    const float y = range(-1, 1), angle = range(0, 2 * kPi), radius = std::sqrt(std::max(0.0f, 1 - y * y));
    return {radius * std::cos(angle), y, radius * std::sin(angle)};
}

void addPatch(Geometry& out, const Patch& patch) {
    const uint32_t first = vertexCount(out);
    const glm::vec3 normal = glm::normalize(glm::cross(patch.u, patch.v));
    for (uint32_t row = 0; row <= patch.rows; ++row)
        for (uint32_t column = 0; column <= patch.columns; ++column) {
            const glm::vec2 st = glm::vec2(column, row) / glm::vec2(patch.columns, patch.rows);
            const glm::vec2 uv = patch.uvOffset + glm::vec2{st.x, 1 - st.y} * patch.uvScale;
            addVertex(out, patch.origin + patch.u * st.x + patch.v * st.y, normal, uv);
        }
    addGridIndices(out, first, patch.columns, patch.rows);
}

void addBox(Geometry& out, const glm::vec3& lo, const glm::vec3& hi) {
    const glm::vec3 size = hi - lo;
    const glm::vec3 x{size.x, 0, 0}, y{0, size.y, 0}, z{0, 0, size.z};
    const auto face = [&](const glm::vec3& origin, const glm::vec3& u, const glm::vec3& v) {
        addPatch(out, {.origin = origin, .u = u, .v = v, .uvScale = {glm::length(u), glm::length(v)}});
    };
    face(lo + z, x, y);
    face(lo + x, -x, y);
    face(lo, z, y);
    face(lo + x + z, -z, y);
    face(lo + y + z, x, -z);
    face(lo, x, z);
}

void addBox(Geometry& out, const glm::mat4& transform, const glm::vec3& lo, const glm::vec3& hi) {
    const size_t first = out.positions.size();
    addBox(out, lo, hi);
    transformFrom(out, first, transform);
}

void addLathe(Geometry& out, const glm::vec3& centre, std::span<const glm::vec2> profile, uint32_t sides) {
    for (size_t i = 0; i + 1 < profile.size(); ++i) {
        if (profile[i] == profile[i + 1]) continue;
        const uint32_t first = vertexCount(out);
        for (size_t ring = i; ring <= i + 1; ++ring)
            for (uint32_t side = 0; side <= sides; ++side) {
                const float turn = static_cast<float>(side) / static_cast<float>(sides);
                const glm::vec3 axis{std::sin(2 * kPi * turn), 0, std::cos(2 * kPi * turn)};
                const glm::vec2 normal = profileNormal(profile, ring);
                const float v = static_cast<float>(ring) / static_cast<float>(profile.size() - 1);
                addVertex(out, centre + axis * profile[ring].x + glm::vec3{0, profile[ring].y, 0},
                          glm::normalize(axis * normal.x + glm::vec3{0, normal.y, 0}), {turn, 1 - v});
            }
        const uint32_t above = first + sides + 1;
        for (uint32_t side = 0; side < sides; ++side) {
            const uint32_t a = first + side, c = above + side;
            if (profile[i].x > 0) out.indices.insert(out.indices.end(), {a, a + 1, c + 1});
            if (profile[i + 1].x > 0) out.indices.insert(out.indices.end(), {a, c + 1, c});
        }
    }
}

void addSphere(Geometry& out, const glm::vec3& centre, const glm::vec3& radii, uint32_t slices,
               uint32_t stacks) {
    std::vector<glm::vec2> profile;
    for (uint32_t i = 0; i <= stacks; ++i) {
        const float angle = kPi * static_cast<float>(i) / static_cast<float>(stacks);
        const bool pole = i == 0 || i == stacks;
        profile.push_back({pole ? 0.0f : std::sin(angle), -std::cos(angle)});
    }
    const size_t first = out.positions.size();
    addLathe(out, glm::vec3{0}, profile, slices);
    // On the unit sphere the position is the exact normal, also at the poles.
    for (size_t i = first; i < out.positions.size(); ++i) out.normals[i] = glm::normalize(out.positions[i]);
    transformFrom(out, first, glm::scale(glm::translate(glm::mat4{1}, centre), radii));
}

void addTube(Geometry& out, std::span<const glm::vec3> path, float radius, uint32_t sides) {
    const uint32_t first = vertexCount(out);
    for (size_t i = 0; i < path.size(); ++i) {
        const glm::vec3 along =
            glm::normalize(path[std::min(i + 1, path.size() - 1)] - path[i > 0 ? i - 1 : i]);
        const glm::vec3 helper = std::abs(along.y) < 0.9f ? glm::vec3{0, 1, 0} : glm::vec3{1, 0, 0};
        const glm::vec3 right = glm::normalize(glm::cross(helper, along)), up = glm::cross(along, right);
        for (uint32_t side = 0; side <= sides; ++side) {
            const float turn = static_cast<float>(side) / static_cast<float>(sides);
            const glm::vec3 outward = right * std::cos(2 * kPi * turn) + up * std::sin(2 * kPi * turn);
            addVertex(out, path[i] + outward * radius, outward, {turn, static_cast<float>(i)});
        }
    }
    addGridIndices(out, first, sides, static_cast<uint32_t>(path.size() - 1));
}

void addTriangle(Geometry& out, const std::array<glm::vec3, 3>& corners) {
    const uint32_t first = vertexCount(out);
    const glm::vec3 normal = glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
    addVertex(out, corners[0], normal, {0, 1});
    addVertex(out, corners[1], normal, {1, 1});
    addVertex(out, corners[2], normal, {0.5f, 0});
    out.indices.insert(out.indices.end(), {first, first + 1, first + 2});
}

void addOctahedron(Geometry& out, const glm::vec3& centre, float radius) {
    for (int octant = 0; octant < 8; ++octant) {
        const glm::vec3 x = centre + glm::vec3{octant & 1 ? -radius : radius, 0, 0};
        const glm::vec3 y = centre + glm::vec3{0, octant & 2 ? -radius : radius, 0};
        const glm::vec3 z = centre + glm::vec3{0, 0, octant & 4 ? -radius : radius};
        const bool mirrored = octant == 1 || octant == 2 || octant == 4 || octant == 7;
        addTriangle(out, mirrored ? std::array{x, z, y} : std::array{x, y, z});
    }
}

std::vector<glm::vec3> hangingWire(const glm::vec3& a, const glm::vec3& b, float sag, uint32_t segments) {
    std::vector<glm::vec3> path;
    for (uint32_t i = 0; i <= segments; ++i) {
        const float t = static_cast<float>(i) / static_cast<float>(segments);
        path.push_back(glm::mix(a, b, t) - glm::vec3{0, 4 * sag * t * (1 - t), 0});
    }
    return path;
}

uint32_t addMaterial(SceneData& scene, const Surface& surface) {
    const auto toGpu = [](const glm::vec3& v) { return restir::gpu::vec3{v.x, v.y, v.z}; };
    uint32_t flags = 0;
    if (surface.doubleSided) flags |= RS_MATERIAL_DOUBLE_SIDED;
    if (surface.alphaMask) flags |= RS_MATERIAL_ALPHA_MASK;
    scene.materials.push_back({.baseColor = {surface.color.x, surface.color.y, surface.color.z, 1},
                               .emission = toGpu(surface.emission),
                               .roughness = surface.roughness,
                               .metalness = surface.metalness,
                               .specular = surface.specular,
                               .normalScale = 1,
                               .alphaCutoff = 0.5f,
                               .baseColorTexture = surface.colorTexture,
                               .metallicRoughnessTexture = surface.roughnessTexture,
                               .normalTexture = surface.normalTexture,
                               .emissionTexture = surface.emissionTexture,
                               .flags = flags});
    return static_cast<uint32_t>(scene.materials.size() - 1);
}

uint32_t addTexture(SceneData& scene, Image image) {
    scene.textures.push_back({.image = static_cast<uint32_t>(scene.images.size())});
    scene.images.push_back(std::move(image));
    return static_cast<uint32_t>(scene.textures.size() - 1);
}

uint32_t addMesh(SceneData& scene, std::vector<Geometry> geometries) {
    std::erase_if(geometries, [](const Geometry& geometry) { return geometry.indices.empty(); });
    if (geometries.empty()) return kNoMesh;
    scene.meshes.push_back({std::move(geometries)});
    return static_cast<uint32_t>(scene.meshes.size() - 1);
}

void addInstance(SceneData& scene, uint32_t mesh, const glm::mat4& worldFromObject) {
    if (mesh != kNoMesh) scene.instances.push_back({mesh, worldFromObject});
}

glm::mat4 place(const glm::vec3& position, float turn, float scale) {
    const glm::mat4 turned = glm::rotate(glm::translate(glm::mat4{1}, position), turn, glm::vec3{0, 1, 0});
    return glm::scale(turned, glm::vec3{scale});
}

}   // namespace samples::build
