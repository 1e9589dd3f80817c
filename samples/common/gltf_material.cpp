#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <thread>

#include <stb/stb_image.h>

#include "gltf_reader.h"

namespace samples::gltf {

using restir::gpu::RsMaterial;

namespace {

constexpr int kMaxImageSide = 16384;
constexpr uint64_t kMaxTexels = uint64_t{1} << 30;   // of all images together, 4 GiB

Wrap wrapMode(int mode) {
    if (mode == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return Wrap::Clamp;
    return mode == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? Wrap::Mirror : Wrap::Repeat;
}

uint64_t texelsOf(std::span<const uint8_t> bytes) {
    const int size = static_cast<int>(std::min<size_t>(bytes.size(), INT32_MAX));
    int width = 0, height = 0, channels = 0;
    if (!stbi_info_from_memory(bytes.data(), size, &width, &height, &channels)) return 0;
    return static_cast<uint64_t>(width) * static_cast<uint64_t>(height);
}

// False: not an image that stb_image reads, too large, or out of memory.
bool decode(std::span<const uint8_t> bytes, Image& image) noexcept try {
    const int size = static_cast<int>(std::min<size_t>(bytes.size(), INT32_MAX));
    int width = 0, height = 0, channels = 0;
    if (!stbi_info_from_memory(bytes.data(), size, &width, &height, &channels)) return false;
    if (width <= 0 || height <= 0 || width > kMaxImageSide || height > kMaxImageSide) return false;
    const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
        stbi_load_from_memory(bytes.data(), size, &width, &height, &channels, STBI_rgb_alpha),
        stbi_image_free);
    if (!pixels) return false;
    image.width = static_cast<uint32_t>(width);
    image.height = static_cast<uint32_t>(height);
    image.rgba.assign(pixels.get(), pixels.get() + size_t{image.width} * image.height * 4);
    return true;
} catch (...) {
    return false;
}

float clamped(double value) {
    return std::isfinite(value) ? std::clamp(static_cast<float>(value), 0.0f, 1.0f) : 0;
}

glm::vec4 color(const std::vector<double>& values, size_t count) {
    glm::vec4 result{1};
    for (size_t i = 0; i < std::min(values.size(), count); ++i)
        result[static_cast<int>(i)] = static_cast<float>(values[i]);
    return result;
}

const tinygltf::Value* extension(const tinygltf::ExtensionMap& extensions, const char* name) {
    const auto found = extensions.find(name);
    return found != extensions.end() && found->second.IsObject() ? &found->second : nullptr;
}

double number(const tinygltf::Value& object, const char* key, double otherwise) {
    const tinygltf::Value& value = object.Get(key);
    return value.IsNumber() ? value.GetNumberAsDouble() : otherwise;
}

glm::vec2 pair(const tinygltf::Value& object, const char* key, glm::vec2 otherwise) {
    const tinygltf::Value& value = object.Get(key);
    if (!value.IsArray() || value.ArrayLen() < 2 || !value.Get(0).IsNumber() || !value.Get(1).IsNumber())
        return otherwise;
    return {value.Get(0).GetNumberAsDouble(), value.Get(1).GetNumberAsDouble()};
}

TextureCoordinates coordinatesOf(int texCoord, const tinygltf::ExtensionMap& extensions) {
    TextureCoordinates result{.set = texCoord};
    if (const auto* transform = extension(extensions, "KHR_texture_transform")) {
        result.set = static_cast<int>(std::clamp(number(*transform, "texCoord", texCoord), 0.0, 15.0));
        result.transform = {.offset = pair(*transform, "offset", glm::vec2(0)),
                            .scale = pair(*transform, "scale", glm::vec2(1)),
                            .rotation = static_cast<float>(number(*transform, "rotation", 0))};
    }
    result.set = std::clamp(result.set, 0, 15);
    return result;
}

// Of each texture of the material.
std::vector<TextureCoordinates> textureUses(const tinygltf::Material& material) {
    const auto& pbr = material.pbrMetallicRoughness;
    std::vector<TextureCoordinates> uses;
    const auto add = [&](const auto& texture) {
        if (texture.index >= 0) uses.push_back(coordinatesOf(texture.texCoord, texture.extensions));
    };
    add(pbr.baseColorTexture);
    add(material.emissiveTexture);
    add(pbr.metallicRoughnessTexture);
    add(material.normalTexture);
    return uses;
}

RsMaterial blankMaterial() {
    return {.baseColor = {1, 1, 1, 1},
            .emission = {},
            .roughness = 1,
            .metalness = 1,
            .specular = 1,
            .normalScale = 1,
            .alphaCutoff = 0.5f,
            .baseColorTexture = RS_NO_TEXTURE,
            .metallicRoughnessTexture = RS_NO_TEXTURE,
            .normalTexture = RS_NO_TEXTURE,
            .emissionTexture = RS_NO_TEXTURE,
            .flags = 0};
}

}   // namespace

glm::vec2 UvTransform::operator()(glm::vec2 uv) const {
    const float s = std::sin(rotation), c = std::cos(rotation);
    uv *= scale;
    return offset + glm::vec2(c * uv.x + s * uv.y, c * uv.y - s * uv.x);
}

Materials::Materials(Reader& reader, SceneData& scene) : reader_(reader), scene_(scene) {
    const auto& materials = reader.model().materials;
    for (size_t i = 0; i < materials.size(); ++i) {
        const std::string field = "materials[" + std::to_string(i) + "]";
        scene_.materials.push_back(convert(materials[i], field));
        const std::vector<TextureCoordinates> uses = textureUses(materials[i]);
        coordinates_.push_back(uses.empty() ? TextureCoordinates{} : uses.front());
        const bool mixed = std::any_of(uses.begin(), uses.end(), [&](const TextureCoordinates& use) {
            return use != coordinates_.back();
        });
        if (mixed)
            reader_.warn(field + ": textures with different TEXCOORD sets or KHR_texture_transforms, all use "
                                 "those of the first");
    }
    if (blendMaterials_ > 0)
        reader_.warn(std::to_string(blendMaterials_) +
                     " materials with alphaMode BLEND: treated as alpha-masked at 0.5");
    decodeImages();
}

uint32_t Materials::sceneIndex(int gltfMaterial, const std::string& field) {
    const size_t count = reader_.model().materials.size();
    if (gltfMaterial >= 0) return static_cast<uint32_t>(reader_.checkedIndex(gltfMaterial, count, field));
    if (defaultMaterial_ == RS_NO_TEXTURE) {
        defaultMaterial_ = static_cast<uint32_t>(scene_.materials.size());
        scene_.materials.push_back(blankMaterial());
    }
    return defaultMaterial_;
}

TextureCoordinates Materials::coordinates(int gltfMaterial) const {
    return gltfMaterial < 0 ? TextureCoordinates{} : coordinates_[static_cast<size_t>(gltfMaterial)];
}

RsMaterial Materials::convert(const tinygltf::Material& material, const std::string& field) {
    const auto& pbr = material.pbrMetallicRoughness;
    RsMaterial out = blankMaterial();
    const glm::vec4 base = color(pbr.baseColorFactor, 4);
    out.baseColor = {clamped(base.x), clamped(base.y), clamped(base.z), clamped(base.w)};
    out.roughness = clamped(pbr.roughnessFactor);
    out.metalness = clamped(pbr.metallicFactor);
    const double scale = material.normalTexture.scale;
    out.normalScale = std::isfinite(scale) ? static_cast<float>(scale) : 1.0f;
    out.baseColorTexture = texture(pbr.baseColorTexture.index, true, field + ".baseColorTexture");
    out.metallicRoughnessTexture =
        texture(pbr.metallicRoughnessTexture.index, false, field + ".metallicRoughnessTexture");
    out.normalTexture = texture(material.normalTexture.index, false, field + ".normalTexture");
    if (material.doubleSided) out.flags |= RS_MATERIAL_DOUBLE_SIDED;
    readEmission(material, out, field);
    readSpecular(material, out, field);
    readAlpha(material, out);
    return out;
}

void Materials::readEmission(const tinygltf::Material& material, RsMaterial& out, const std::string& field) {
    out.emissionTexture = texture(material.emissiveTexture.index, true, field + ".emissiveTexture");
    if (material.emissiveFactor.size() < 3) return;
    double strength = 1;
    if (const auto* emissive = extension(material.extensions, "KHR_materials_emissive_strength"))
        strength = number(*emissive, "emissiveStrength", 1);
    const glm::vec3 emission = glm::vec3{color(material.emissiveFactor, 3)} * static_cast<float>(strength);
    const float smallest = std::min({emission.x, emission.y, emission.z});
    if (!std::isfinite(emission.x + emission.y + emission.z) || smallest < 0)
        reader_.fail(field + ".emissiveFactor", "negative or not finite");
    out.emission = {emission.x, emission.y, emission.z};
}

void Materials::readSpecular(const tinygltf::Material& material, RsMaterial& out, const std::string& field) {
    const auto* specular = extension(material.extensions, "KHR_materials_specular");
    if (!specular) return;
    out.specular = clamped(number(*specular, "specularFactor", 1));
    if (specular->Has("specularTexture") || specular->Has("specularColorTexture") ||
        specular->Has("specularColorFactor"))
        reader_.warn(field + ": of KHR_materials_specular only specularFactor is used");
}

// Rays are blocked or not, nothing between: BLEND is a mask at one half, so that a surface more transparent
// than opaque (the glass tubes of a neon sign, the clear parts of a decal) is not there and the rest is
// solid.
void Materials::readAlpha(const tinygltf::Material& material, RsMaterial& out) {
    if (material.alphaMode == "BLEND")
        ++blendMaterials_;
    else if (material.alphaMode != "MASK")
        return;
    out.alphaCutoff = material.alphaMode == "MASK" ? static_cast<float>(material.alphaCutoff) : 0.5f;
    const bool canPass = out.baseColorTexture != RS_NO_TEXTURE || out.baseColor.w < out.alphaCutoff;
    if (canPass) out.flags |= RS_MATERIAL_ALPHA_MASK;
}

uint32_t Materials::texture(int index, bool srgb, const std::string& field) {
    if (index < 0) return RS_NO_TEXTURE;
    const auto& model = reader_.model();
    const auto& source = model.textures[reader_.checkedIndex(index, model.textures.size(), field)];
    const auto [slot, added] = textures_.try_emplace({index, srgb}, RS_NO_TEXTURE);
    if (!added) return slot->second;
    const std::string name = "textures[" + std::to_string(index) + "]";
    if (source.source < 0) {
        reader_.warn(name + ": has no image of a core format, ignored");
        return RS_NO_TEXTURE;
    }
    Texture result;
    result.image = image(reader_.checkedIndex(source.source, model.images.size(), name + ".source"), srgb);
    if (source.sampler >= 0) {
        const auto& sampler =
            model.samplers[reader_.checkedIndex(source.sampler, model.samplers.size(), name + ".sampler")];
        result.wrapU = wrapMode(sampler.wrapS);
        result.wrapV = wrapMode(sampler.wrapT);
        result.nearest = sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST;
    }
    slot->second = static_cast<uint32_t>(scene_.textures.size());
    scene_.textures.push_back(result);
    return slot->second;
}

uint32_t Materials::image(size_t gltfImage, bool srgb) {
    const auto next = static_cast<uint32_t>(images_.size());
    return images_.try_emplace({gltfImage, srgb}, next).first->second;
}

void Materials::decodeImages() {
    struct Job {
        size_t gltfImage;
        std::span<const uint8_t> bytes;
        Image* target;
        bool decoded = false;
    };
    scene_.images.resize(images_.size());
    std::vector<Job> jobs;
    uint64_t texels = 0;
    for (const auto& [use, index] : images_) {
        scene_.images[index].srgb = use.srgb;
        jobs.push_back({use.gltfImage, reader_.imageBytes(use.gltfImage), &scene_.images[index]});
        texels += texelsOf(jobs.back().bytes);
    }
    if (texels > kMaxTexels) reader_.fail("images", "more than 2^30 texels together");
    std::atomic<size_t> next = 0;
    const auto work = [&] {
        for (size_t i = next++; i < jobs.size(); i = next++)
            jobs[i].decoded = decode(jobs[i].bytes, *jobs[i].target);
    };
    {
        const size_t threads =
            std::min<size_t>(jobs.size(), std::max(1u, std::thread::hardware_concurrency()));
        std::vector<std::jthread> pool;
        for (size_t t = 0; t < threads; ++t) pool.emplace_back(work);
    }
    for (const Job& job : jobs)
        if (!job.decoded)
            reader_.fail("images[" + std::to_string(job.gltfImage) + "]",
                         "not a PNG, JPEG or other image stb_image reads, or larger than 16384 a side: " +
                             reader_.model().images[job.gltfImage].uri);
}

}   // namespace samples::gltf
