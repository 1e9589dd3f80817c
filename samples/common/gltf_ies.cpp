// EXT_lights_ies: point lights with photometric profiles.
#include <stdexcept>

#include "common/ies.h"
#include "gltf_reader.h"

namespace samples::gltf {

Profiles::Profiles(Reader& reader, SceneData& scene) : reader_(reader), scene_(scene) {
    const auto& extensions = reader.model().extensions;
    const auto found = extensions.find("EXT_lights_ies");
    if (found == extensions.end() || !found->second.Has("lights")) return;
    const tinygltf::Value& lights = found->second.Get("lights");
    for (size_t i = 0; lights.IsArray() && i < lights.ArrayLen(); ++i)
        lights_.push_back(lights.Get(static_cast<int>(i)));
    profiles_.resize(lights_.size());
}

const Profiles::Profile& Profiles::profile(int index, const std::string& field) {
    const size_t i = reader_.checkedIndex(index, profiles_.size(), field);
    if (profiles_[i]) return *profiles_[i];
    const std::string name = "extensions.EXT_lights_ies.lights[" + std::to_string(i) + "]";
    std::string text;
    if (lights_[i].Has("uri") && lights_[i].Get("uri").IsString()) {
        const std::vector<uint8_t> bytes =
            reader_.uriBytes(lights_[i].Get("uri").Get<std::string>(), name + ".uri");
        text.assign(bytes.begin(), bytes.end());
    } else {
        const tinygltf::Value& view = lights_[i].Get("bufferView");
        const auto bytes = reader_.viewBytes(view.IsInt() ? view.GetNumberAsInt() : -1, name + ".bufferView");
        text.assign(bytes.begin(), bytes.end());
    }
    try {
        PhotometricProfile read = readIes(text);
        profiles_[i] = {
            .texture = static_cast<uint32_t>(scene_.textures.size()), .peak = read.peak, .mean = read.mean};
        scene_.textures.push_back(
            {.image = static_cast<uint32_t>(scene_.images.size()), .wrapV = Wrap::Clamp});
        scene_.images.push_back(std::move(read.image));
    } catch (const std::runtime_error& error) {
        reader_.fail(name, error.what());
    }
    return *profiles_[i];
}

void Profiles::addLight(const tinygltf::Value& instance, const glm::mat4& world, const std::string& field) {
    const tinygltf::Value& index = instance.Get("light");
    const Profile& profile = this->profile(index.IsInt() ? index.GetNumberAsInt() : -1, field + ".light");
    PunctualLight light{.position = glm::vec3{world[3]}};
    glm::vec3 color{1};
    if (const tinygltf::Value& given = instance.Get("color"); given.IsArray() && given.ArrayLen() == 3)
        for (int i = 0; i < 3; ++i) color[i] = static_cast<float>(given.Get(i).GetNumberAsDouble());
    const double multiplier =
        instance.Has("multiplier") ? instance.Get("multiplier").GetNumberAsDouble() : 1.0;
    light.intensity = glm::clamp(color, 0.0f, 1.0f) * static_cast<float>(multiplier) * profile.peak;
    if (!(multiplier >= 0) || !(light.intensity.x + light.intensity.y + light.intensity.z < 1e30f))
        reader_.fail(field, "multiplier or color negative or not finite");
    // Without the node's scale; a node without extent keeps the file's axes.
    glm::mat3 axes{world};
    for (int i = 0; i < 3; ++i) axes[i] /= std::max(glm::length(axes[i]), 1e-30f);
    const bool turns = std::abs(glm::determinant(axes)) > 0.99f;
    if (turns) light.profileTurn = glm::normalize(glm::quat_cast(glm::determinant(axes) < 0 ? -axes : axes));
    light.profile = profile.texture;
    light.profileMean = profile.mean;
    scene_.punctual.push_back(light);
}

}   // namespace samples::gltf
