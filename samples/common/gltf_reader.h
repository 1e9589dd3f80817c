// Inside of loadGltf: the parsed document with its checks. Nothing outside gltf*.cpp includes this.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <tiny_gltf.h>
#include <glm/glm.hpp>

#include "scene.h"

namespace samples::gltf {

// The document, where it came from, and where its warnings go.
class Reader {
public:
    Reader(std::string path, std::vector<std::string>& warnings);

    const tinygltf::Model& model() const { return model_; }

    [[noreturn]] void fail(const std::string& field, const std::string& what) const;
    // One line per distinct text, however often it is reported.
    void warn(const std::string& what);

    // Throws unless index is in [0, count).
    size_t checkedIndex(int index, size_t count, const std::string& field) const;
    std::span<const uint8_t> viewBytes(int bufferView, const std::string& field) const;
    std::span<const uint8_t> imageBytes(size_t image) const;
    // A file next to this one, or what a data URI holds.
    std::vector<uint8_t> uriBytes(const std::string& uri, const std::string& field) const;

    size_t accessorCount(int accessor, const std::string& field) const;
    // `out` holds accessorCount * components floats; normalized integers are converted.
    void readFloats(int accessor, int components, std::span<float> out, const std::string& field) const;
    std::vector<uint32_t> readIndices(int accessor, const std::string& field) const;

private:
    struct Elements;   // a strided run of accessor elements, bounds checked
    Elements elementsOf(int accessor, int components, const std::string& field) const;
    void applySparse(const tinygltf::Accessor& accessor, std::span<float> out,
                     const std::string& field) const;
    void parse(const std::vector<uint8_t>& bytes);

    tinygltf::Model model_;
    std::string path_;
    std::vector<std::string>& warnings_;
};

// KHR_texture_transform: scaled, turned, moved.
struct UvTransform {
    glm::vec2 offset{0}, scale{1};
    float rotation = 0;   // radians, counter-clockwise where v points down
    glm::vec2 operator()(glm::vec2 uv) const;
    bool operator==(const UvTransform&) const = default;
};

// Which coordinates a material's textures use.
struct TextureCoordinates {
    int set = 0;
    UvTransform transform;
    bool operator==(const TextureCoordinates&) const = default;
};

// Appends materials, textures and images to the scene and remembers how primitives refer to them.
class Materials {
public:
    Materials(Reader& reader, SceneData& scene);

    // SceneData's material index for a primitive's material (-1: glTF's default material).
    uint32_t sceneIndex(int gltfMaterial, const std::string& field);
    TextureCoordinates coordinates(int gltfMaterial) const;

private:
    restir::gpu::RsMaterial convert(const tinygltf::Material& material, const std::string& field);
    void readEmission(const tinygltf::Material& material, restir::gpu::RsMaterial& out,
                      const std::string& field);
    void readSpecular(const tinygltf::Material& material, restir::gpu::RsMaterial& out,
                      const std::string& field);
    void readAlpha(const tinygltf::Material& material, restir::gpu::RsMaterial& out);
    uint32_t texture(int index, bool srgb, const std::string& field);
    uint32_t image(size_t gltfImage, bool srgb);
    void decodeImages();

    struct ImageUse {
        size_t gltfImage;
        bool srgb;
        auto operator<=>(const ImageUse&) const = default;
    };
    Reader& reader_;
    SceneData& scene_;
    std::map<ImageUse, uint32_t> images_;
    std::map<std::pair<int, bool>, uint32_t> textures_;
    std::vector<TextureCoordinates> coordinates_;
    uint32_t defaultMaterial_ = RS_NO_TEXTURE;
    size_t blendMaterials_ = 0;
};

// EXT_lights_ies; a profile is read, and its texture made, when a light needs it.
class Profiles {
public:
    Profiles(Reader& reader, SceneData& scene);
    void addLight(const tinygltf::Value& instance, const glm::mat4& world, const std::string& field);

private:
    struct Profile {
        uint32_t texture = 0;
        float peak = 0, mean = 0;
    };
    const Profile& profile(int index, const std::string& field);

    Reader& reader_;
    SceneData& scene_;
    std::vector<tinygltf::Value> lights_;
    std::vector<std::optional<Profile>> profiles_;
};

Mesh convertMesh(Reader& reader, Materials& materials, size_t mesh);

}   // namespace samples::gltf
