// .gltf files that nobody exported: any bytes, or a good file in which some values are others. What is not
// accepted must be refused with the file's name; what is accepted must be whole enough for all that the
// samples do with it without a GPU.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

#include <unistd.h>

#include "common/prepare_scene.h"
#include "common/scene.h"
#include "common/scene_lights.h"
#include "fuzz/take.h"
#include "fuzz/target.h"

namespace fuzz {
namespace {

constexpr uint8_t kEdited = 'E';           // begins inputs that are edits of kGood
constexpr size_t kMostIndices = 100'000;   // of scenes that are looked at further
constexpr int64_t kMostTexels = 1 << 20;

// Two triangles, one of them indexed, with everything that the importer reads.
const char kGood[] = R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
"extensionsUsed":["KHR_lights_punctual","KHR_texture_transform"],
"extensions":{"KHR_lights_punctual":{"lights":[{"type":"spot","intensity":3,"range":5,"color":[1,1,1],
"spot":{"innerConeAngle":0.1,"outerConeAngle":0.5}},{"type":"point"},{"type":"directional"}]}},
"nodes":[{"mesh":0,"translation":[5,0,0],"rotation":[0,0,0,1],"scale":[1,1,1],"children":[1,2]},
{"mesh":1,"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]},{"camera":0,"extensions":{"KHR_lights_punctual":{"light":0}}}],
"cameras":[{"type":"perspective","perspective":{"yfov":0.8,"znear":0.1}}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0,"NORMAL":0,"TEXCOORD_0":1},"material":0,"mode":4}]},
{"primitives":[{"attributes":{"POSITION":3},"indices":2,"material":1,"mode":5}]}],
"accessors":[{"bufferView":0,"byteOffset":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},
{"bufferView":1,"componentType":5126,"count":3,"type":"VEC2","normalized":false},
{"bufferView":2,"componentType":5121,"count":3,"type":"SCALAR"},
{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","sparse":{"count":1,
"indices":{"bufferView":2,"byteOffset":0,"componentType":5121},"values":{"bufferView":0,"byteOffset":12}}}],
"bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":36},{"buffer":0,"byteLength":32,"byteStride":12},
{"buffer":0,"byteOffset":0,"byteLength":3}],
"buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}],
"materials":[{"pbrMetallicRoughness":{"baseColorFactor":[1,1,1,1],"roughnessFactor":0.5,"metallicFactor":0,
"baseColorTexture":{"index":0,"texCoord":0,"extensions":{"KHR_texture_transform":{"offset":[0,0],"scale":[2,4],
"rotation":1.5,"texCoord":0}}},"metallicRoughnessTexture":{"index":0}},"normalTexture":{"index":0,"scale":1},
"emissiveFactor":[1,1,1],"emissiveTexture":{"index":0},"alphaMode":"MASK","alphaCutoff":0.5,"doubleSided":true,
"extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":5},"KHR_materials_specular":{"specularFactor":0.5}}},
{"emissiveFactor":[0,1,0]}],
"samplers":[{"wrapS":33071,"wrapT":33648,"magFilter":9728}],"textures":[{"source":0,"sampler":0}],
"images":[{"uri":"data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNk+M/wHwAEBgIApD5fRAAAAABJRU5ErkJggg=="}]})";

const char* const kHostile[] = {"-1",
                                "0",
                                "1",
                                "2",
                                "3",
                                "4",
                                "7",
                                "36",
                                "255",
                                "4096",
                                "65535",
                                "2147483647",
                                "-2147483648",
                                "4294967295",
                                "4294967296",
                                "9223372036854775807",
                                "18446744073709551615",
                                "1e9",
                                "1e30",
                                "-1e30",
                                "3.4e38",
                                "1e39",
                                "1e308",
                                "-1e308",
                                "1e-45",
                                "0.5",
                                "-0.5",
                                "5120",
                                "5122",
                                "5123",
                                "5124",
                                "5125",
                                "5126",
                                "5130",
                                "6",
                                "null",
                                "true",
                                "\"\"",
                                "\"x\"",
                                "\"VEC4\"",
                                "\"MAT4\"",
                                "\"SCALAR\"",
                                "\"VEC2\"",
                                "\"BLEND\"",
                                "\"orthographic\"",
                                "\"\\u0000\"",
                                "[]",
                                "{}",
                                "[1]",
                                "[-1]",
                                "[0,0,0]",
                                "[1e38,1e38,1e38]"};

// Where each value of a JSON text begins and ends: what follows a colon, or is an array's.
struct Part {
    size_t begin, end;
};
std::vector<Part> valuesOf(const std::string& json) {
    std::vector<Part> values;
    for (size_t i = 1; i < json.size(); ++i) {
        const char before = json[i - 1];
        if ((before != ':' && before != '[' && before != ',') || json[i] == '{' || json[i] == '\n') continue;
        if (before == ',' && json[i] == '"') continue;   // a key
        size_t end = i;
        if (json[i] == '"')
            end = json.find('"', i + 1) + 1;
        else if (json[i] == '[')
            end = json.find(']', i) + 1;
        else
            end = json.find_first_of(",]}", i);
        values.push_back({i, end});
    }
    return values;
}

std::string edited(Take take) {
    static const std::vector<Part> values = valuesOf(kGood);
    std::vector<std::string> replaced(values.size());
    while (!take.empty()) {
        const size_t at = take.value<uint16_t>() % values.size();
        replaced[at] = kHostile[take.below(std::size(kHostile))];
    }
    std::string text = kGood;
    for (size_t i = values.size(); i-- > 0;) {
        const Part part = values[i];
        const bool inside =
            i > 0 && values[i - 1].end >= part.end;   // of an array that may be replaced itself
        if (!replaced[i].empty() && !(inside && !replaced[i - 1].empty()))
            text.replace(part.begin, part.end - part.begin, replaced[i]);
    }
    return text;
}

void insist(bool condition, const char* what) {
    if (condition) return;
    std::fprintf(stderr, "%s\n", what);
    std::abort();
}

size_t indexCount(const samples::SceneData& scene) {
    size_t count = 0;
    for (const samples::Instance& instance : scene.instances)
        for (const samples::Geometry& geometry : scene.meshes.at(instance.mesh).geometries)
            count += geometry.indices.size();
    return count;
}

int64_t texelCount(const samples::SceneData& scene) {
    int64_t count = 0;
    for (const samples::Image& image : scene.images) count += int64_t{image.width} * image.height;
    return count;
}

void expectWhole(const samples::SceneData& scene) {
    for (const samples::Mesh& mesh : scene.meshes)
        for (const samples::Geometry& geometry : mesh.geometries) {
            insist(geometry.material < scene.materials.size(), "a material that is not there");
            for (uint32_t index : geometry.indices)
                insist(index < geometry.positions.size(), "a vertex that is not there");
            for (const glm::vec3& p : geometry.positions)
                insist(std::isfinite(p.x + p.y + p.z) || !std::isnan(p.x), "NaN");
        }
    for (const samples::Instance& instance : scene.instances)
        for (int i = 0; i < 16; ++i)
            insist(std::isfinite(instance.worldFromObject[i / 4][i % 4]), "a transform without end");
    for (const samples::Texture& texture : scene.textures)
        insist(texture.image < scene.images.size(), "an image that is not there");
}

// As the programs do.
void use(samples::SceneData scene) {
    expectWhole(scene);
    (void)samples::frameScene(scene);
    if (indexCount(scene) > kMostIndices || texelCount(scene) > kMostTexels) return;
    samples::prepareScene(scene);
    const samples::SceneLights lights = samples::makeSceneLights(scene);
    (void)samples::lightsAt(lights, samples::restOf(scene));
    (void)samples::referenceAt(lights, samples::restOf(scene));
}

const std::string& path() {
    static const std::filesystem::path memory = "/dev/shm";   // many times faster than a disk
    static const std::string name =
        ((std::filesystem::is_directory(memory) ? memory : std::filesystem::temp_directory_path()) /
         ("restir-fuzz-" + std::to_string(getpid()) + ".gltf"))
            .string();
    static const int removed = std::atexit([] { std::filesystem::remove(path()); });
    (void)removed;
    return name;
}

void run(std::span<const uint8_t> bytes) {
    const bool edits = !bytes.empty() && bytes[0] == kEdited;
    const std::string text = edits ? edited(Take(bytes.subspan(1))) : std::string(bytes.begin(), bytes.end());
    std::ofstream(path(), std::ios::binary) << text;
    std::vector<std::string> warnings;
    try {
        use(samples::loadGltf(path(), warnings));
    } catch (const std::runtime_error& error) {
        const std::string what = error.what();
        insist(what.find(path()) == 0 || what.find("maxLights") != std::string::npos, what.c_str());
    }
}

// The file itself, as text and in a .glb, and edits of it.
std::vector<Bytes> seeds() {
    const std::string good = kGood;
    Bytes binary{'g', 'l', 'T', 'F', 2, 0, 0, 0};
    const auto word = [&](size_t value) {
        for (int i = 0; i < 4; ++i) binary.push_back(uint8_t(value >> 8 * i));
    };
    const size_t padded = (good.size() + 3) / 4 * 4;
    word(20 + padded);
    word(padded);
    binary.insert(binary.end(), {'J', 'S', 'O', 'N'});
    binary.insert(binary.end(), good.begin(), good.end());
    binary.resize(20 + padded, ' ');
    std::vector<Bytes> all{Bytes(good.begin(), good.end()), binary, {kEdited}};
    for (uint8_t choice = 0; choice < std::size(kHostile); ++choice)
        all.push_back({kEdited, uint8_t(5 * choice), 0, choice});
    return all;
}

}   // namespace

const Target kGltf{"gltf", run, seeds};

}   // namespace fuzz
