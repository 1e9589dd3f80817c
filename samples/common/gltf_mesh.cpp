#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "gltf_reader.h"

namespace samples::gltf {

namespace {

constexpr size_t kMaxIndices = size_t{1} << 30;   // per primitive, after strips and fans are unrolled

bool finite(const glm::vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

template <typename Vector>
std::vector<Vector> readStream(const Reader& reader, int accessor, const std::string& field) {
    constexpr int kWidth = Vector::length();
    std::vector<Vector> stream(reader.accessorCount(accessor, field));
    if (stream.empty()) return stream;
    reader.readFloats(accessor, kWidth, {&stream.front().x, stream.size() * size_t{kWidth}}, field);
    return stream;
}

int attribute(const tinygltf::Primitive& primitive, const std::string& name) {
    const auto found = primitive.attributes.find(name);
    return found == primitive.attributes.end() ? -1 : found->second;
}

// Triangle i of a strip or fan; both keep the winding of the first triangle.
glm::uvec3 corners(int mode, uint32_t i) {
    if (mode == TINYGLTF_MODE_TRIANGLE_FAN) return {0, i + 1, i + 2};
    return i % 2 == 0 ? glm::uvec3{i, i + 1, i + 2} : glm::uvec3{i + 1, i, i + 2};
}

std::vector<uint32_t> unroll(const std::vector<uint32_t>& source, int mode) {
    std::vector<uint32_t> indices;
    if (source.size() < 3) return indices;
    indices.reserve((source.size() - 2) * 3);
    for (uint32_t i = 0; i + 2 < source.size(); ++i) {
        const glm::uvec3 corner = corners(mode, i);
        indices.insert(indices.end(), {source[corner.x], source[corner.y], source[corner.z]});
    }
    return indices;
}

std::vector<uint32_t> triangleIndices(Reader& reader, const tinygltf::Primitive& primitive,
                                      size_t vertexCount, const std::string& field) {
    std::vector<uint32_t> indices;
    if (primitive.indices >= 0) {
        indices = reader.readIndices(primitive.indices, field + ".indices");
    } else {
        indices.resize(vertexCount);
        std::iota(indices.begin(), indices.end(), 0u);
    }
    if (indices.size() > kMaxIndices / 3) reader.fail(field, "too many indices");
    const auto largest = std::max_element(indices.begin(), indices.end());
    if (largest != indices.end() && *largest >= vertexCount)
        reader.fail(field + ".indices",
                    "index " + std::to_string(*largest) + " of " + std::to_string(vertexCount) + " vertices");
    if (primitive.mode != TINYGLTF_MODE_TRIANGLES) return unroll(indices, primitive.mode);
    if (indices.size() % 3 != 0) {
        reader.warn(field + ": index count is no multiple of three, the rest is dropped");
        indices.resize(indices.size() / 3 * 3);
    }
    return indices;
}

// Gives vertices without a usable normal the mean of their triangles' normals.
void repairNormals(Reader& reader, Geometry& geometry, const std::string& field) {
    const auto usable = [](const glm::vec3& n) { return finite(n) && glm::dot(n, n) > 0.0f; };
    const auto bad = std::count_if(geometry.normals.begin(), geometry.normals.end(), std::not_fn(usable));
    if (bad == 0) return;
    reader.warn(field + ".NORMAL: " + std::to_string(bad) + " unusable normals were recomputed");
    std::vector<glm::vec3> sums(geometry.positions.size(), glm::vec3{0});
    for (size_t i = 0; i < geometry.indices.size(); i += 3) {
        const uint32_t* triangle = &geometry.indices[i];
        const glm::vec3 origin = geometry.positions[triangle[0]];
        const glm::vec3 areaNormal =
            glm::cross(geometry.positions[triangle[1]] - origin, geometry.positions[triangle[2]] - origin);
        for (size_t corner = 0; corner < 3; ++corner) sums[triangle[corner]] += areaNormal;
    }
    for (size_t v = 0; v < geometry.normals.size(); ++v) {
        if (usable(geometry.normals[v])) continue;
        geometry.normals[v] = usable(sums[v]) ? glm::normalize(sums[v]) : glm::vec3{0, 1, 0};
    }
}

void readNormals(Reader& reader, const tinygltf::Primitive& primitive, Geometry& geometry,
                 const std::string& field) {
    const int accessor = attribute(primitive, "NORMAL");
    if (accessor < 0) return;
    geometry.normals = readStream<glm::vec3>(reader, accessor, field + ".NORMAL");
    if (geometry.normals.size() != geometry.positions.size())
        reader.fail(field + ".NORMAL", "count differs from POSITION's");
    repairNormals(reader, geometry, field);
}

void readUvs(Reader& reader, const tinygltf::Primitive& primitive, const TextureCoordinates& coordinates,
             Geometry& geometry, const std::string& field) {
    const std::string name = "TEXCOORD_" + std::to_string(coordinates.set);
    const int accessor = attribute(primitive, name);
    if (accessor < 0) return;
    const std::string path = field + "." + name;
    geometry.uvs = readStream<glm::vec2>(reader, accessor, path);
    if (geometry.uvs.size() != geometry.positions.size()) reader.fail(path, "count differs from POSITION's");
    if (coordinates.transform != UvTransform{})
        std::transform(geometry.uvs.begin(), geometry.uvs.end(), geometry.uvs.begin(), coordinates.transform);
    const auto bad = [](const glm::vec2& uv) { return !std::isfinite(uv.x) || !std::isfinite(uv.y); };
    if (std::none_of(geometry.uvs.begin(), geometry.uvs.end(), bad)) return;
    reader.warn(path + ": values that are not finite were set to zero");
    std::replace_if(geometry.uvs.begin(), geometry.uvs.end(), bad, glm::vec2{0});
}

bool isTriangles(int mode) {
    return mode == TINYGLTF_MODE_TRIANGLES || mode == TINYGLTF_MODE_TRIANGLE_STRIP ||
           mode == TINYGLTF_MODE_TRIANGLE_FAN;
}

Geometry convertPrimitive(Reader& reader, Materials& materials, const tinygltf::Primitive& primitive,
                          const std::string& field) {
    Geometry geometry;
    geometry.positions =
        readStream<glm::vec3>(reader, attribute(primitive, "POSITION"), field + ".attributes.POSITION");
    if (!std::all_of(geometry.positions.begin(), geometry.positions.end(), finite))
        reader.fail(field + ".attributes.POSITION", "a value is no finite number");
    geometry.indices = triangleIndices(reader, primitive, geometry.positions.size(), field);
    readNormals(reader, primitive, geometry, field + ".attributes");
    geometry.material = materials.sceneIndex(primitive.material, field + ".material");
    readUvs(reader, primitive, materials.coordinates(primitive.material), geometry, field + ".attributes");
    if (!primitive.targets.empty()) reader.warn("morph targets are ignored");
    return geometry;
}

}   // namespace

Mesh convertMesh(Reader& reader, Materials& materials, size_t index) {
    Mesh mesh;
    const auto& primitives = reader.model().meshes[index].primitives;
    for (size_t p = 0; p < primitives.size(); ++p) {
        const std::string field =
            "meshes[" + std::to_string(index) + "].primitives[" + std::to_string(p) + "]";
        if (!isTriangles(primitives[p].mode)) {
            reader.warn("primitives of mode " + std::to_string(primitives[p].mode) +
                        " (points or lines) are skipped");
            continue;
        }
        Geometry geometry = convertPrimitive(reader, materials, primitives[p], field);
        if (!geometry.indices.empty()) mesh.geometries.push_back(std::move(geometry));
    }
    return mesh;
}

}   // namespace samples::gltf
