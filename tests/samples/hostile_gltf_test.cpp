// Files that nobody exported: each ends in a message of one line that names the file and the field.
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "common/scene.h"
#include "samples/gltf_file.h"

namespace {

using namespace tests;

std::string errorOf(const std::string& path) {
    std::vector<std::string> warnings;
    try {
        samples::loadScene(path, warnings);
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return {};
}

void expectError(const std::string& text, const std::string& field) {
    const TemporaryFile file("hostile.gltf", text);
    const std::string error = errorOf(file.path());
    EXPECT_EQ(error.find(file.path()), 0u) << "said: '" << error << "', without the file";
    EXPECT_NE(error.find(field, file.path().size()), std::string::npos)
        << "said: '" << error << "', without " << field;
    EXPECT_EQ(error.find('\n'), std::string::npos) << error;
}

// kTriangle with one thing changed.
struct Change {
    std::string from, to, field;
};
void expectErrors(const std::vector<Change>& changes) {
    for (const auto& [from, to, field] : changes) {
        SCOPED_TRACE(to);
        expectError(replaced(kTriangle, from, to), field);
    }
}

const std::string
    kComponent = R"("componentType":5126)",
    kView = R"({"buffer":0,"byteLength":36})", kNode = R"({"mesh":0,)",
    kUri = R"("uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA")";

TEST(HostileGltf, EveryTruncation) {
    const std::string whole = kTriangle;
    for (size_t length = 0; length + 1 < whole.size(); length += 7)
        expectError(whole.substr(0, length), ": ");
}

TEST(HostileGltf, NotWhatItSeems) {
    expectError("", "document");
    expectError("PK\x03\x04", "document");
    expectError("glTF", "document");
    expectError(std::string("glTF\2\0\0\0\xff\xff\xff\x7f\xff\xff\xff\x7fJSON{}", 22), "document");
    expectError("null", "document");
    expectError("[1, 2]", "document");
    expectError(std::string(100'000, '['), "nested too deeply");
    expectError(R"({"asset":{"version":"2.0"},"extras":)" + std::string(100'000, '['), "nested too deeply");
}

TEST(HostileGltf, Nodes) {
    expectErrors({{kNode, R"({"children":[0],"mesh":0,)", "nodes[0]"},
                  {R"("scenes":[{"nodes":[0]}])", R"("scenes":[{"nodes":[0,0]}])", "nodes[0]"},
                  {R"("nodes":[0])", R"("nodes":[3])", "scene.nodes"},
                  {R"("nodes":[0])", R"("nodes":[-1])", "scene.nodes"},
                  {R"("scene":0)", R"("scene":5)", "scene"},
                  {kNode, R"({"mesh":0,"children":[8],)", "nodes[0].children"},
                  {kNode, R"({"mesh":7,)", "nodes[0].mesh"},
                  {kNode, R"({"mesh":0,"camera":0,)", "nodes[0].camera"},
                  {R"([5,0,0])", R"([1e39,0,0])", "nodes[0]: its transform is not finite"},
                  {R"("translation":[5,0,0])", R"("scale":[1e308,1e308,1e308])", "nodes[0]"},
                  {kNode, R"({"mesh":0,"extensions":{"KHR_lights_punctual":{"light":2}},)",
                   "nodes[0].KHR_lights_punctual.light"}});
    // A chain of many nodes costs no stack.
    std::string chain;
    for (int i = 1; i < 100'000; ++i) chain += R"({"children":[)" + std::to_string(i) + "]},";
    const TemporaryFile deep("deep.gltf", replaced(kTriangle, R"("nodes":[{)", R"("nodes":[)" + chain + "{"));
    EXPECT_EQ(errorOf(deep.path()), "");
}

TEST(HostileGltf, Accessors) {
    const std::string position = "POSITION (accessors[0])";
    expectErrors(
        {{R"("POSITION":0)", R"("POSITION":1)", "meshes[0].primitives[0].attributes.POSITION"},
         {R"("count":3)", R"("count":4)", position},
         {R"("count":3)", R"("count":4294967295)", "POSITION: too many elements"},
         {R"("count":3)", R"("count":18446744073709551615)", "POSITION: too many elements"},
         {R"("bufferView":0,"componentType":5126,"count":3)", R"("componentType":5126,"count":200000000)",
          position},
         {kComponent, R"("componentType":5130)", position},
         {kComponent, R"("componentType":5124)", position},
         {R"("type":"VEC3")", R"("type":"VEC4")", position},
         {kComponent, R"("byteOffset":4,"componentType":5126)", position},
         {kComponent, R"("byteOffset": -4,"componentType":5126)", "byteOffset: is negative"},
         {kComponent, R"("byteOffset":18446744073709551612,"componentType":5126)", ": "},
         {R"("bufferView":0)", R"("bufferView":9)", position},
         {"gD8AAAAA", "wH8AAAAA", "attributes.POSITION: a value is no finite number"},
         {R"("type":"VEC3",)",
          R"("type":"VEC3","sparse":{"count":-1,"indices":{"bufferView":0,"componentType":5121},"values":{"bufferView":0}},)",
          "count: is negative"},
         {R"("type":"VEC3",)",
          R"("type":"VEC3","sparse":{"count":900,"indices":{"bufferView":0,"componentType":5121},"values":{"bufferView":0}},)",
          "POSITION.sparse"}});
}

TEST(HostileGltf, Buffers) {
    const std::string folder = std::filesystem::temp_directory_path().string();
    expectErrors(
        {{kView, R"({"buffer":0,"byteLength":360})", "bufferViews[0]"},
         {kView, R"({"buffer":3,"byteLength":36})", "bufferViews[0].buffer"},
         {kView, R"({"buffer":0,"byteOffset":18446744073709551615,"byteLength":36})", "bufferViews[0]"},
         {kView, R"({"buffer":0,"byteLength":36,"byteStride":4})", "byteStride"},
         {kUri, R"("uri":"not there.bin")", "not there.bin"},
         {kUri, R"("uri":"")", ": "},
         {kUri, R"("uri":"/")", ": "},
         {kUri, R"("uri":"/dev/zero")", ": "},
         {kUri, R"("uri":"data:application/octet-stream;base64,AAAA")", ": "},
         {R"("byteLength":36,"uri")", R"("byteLength":4000000000,"uri")", ": "}});
}

TEST(HostileGltf, MaterialsAndImages) {
    const auto with = [](const std::string& parts) {
        return replaced(replaced(kTriangle, R"("POSITION":0})", R"("POSITION":0},"material":0)"),
                        R"("meshes")", parts + R"(,"meshes")");
    };
    expectError(replaced(kTriangle, R"("POSITION":0})", R"("POSITION":0},"material":4)"),
                "primitives[0].material");
    expectError(with(R"("materials":[{"emissiveFactor":[-1,0,0]}])"), "materials[0].emissiveFactor");
    expectError(
        with(
            R"("materials":[{"emissiveFactor":[1,1,1],"extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":1e300}}}])"),
        "materials[0].emissiveFactor");
    expectError(with(R"("materials":[{"emissiveTexture":{"index":6}}])"), "materials[0].emissiveTexture");
    const std::string textured =
        R"("materials":[{"emissiveTexture":{"index":0}}],"textures":[{"source":0}],"images":)";
    expectError(with(textured + R"([{"uri":"data:image/png;base64,AAAAAAAAAAAA"}])"), "images[0]");
    expectError(with(textured + R"([{"bufferView":5,"mimeType":"image/png"}])"), "bufferView");
    expectError(
        with(R"("materials":[{"emissiveTexture":{"index":0}}],"textures":[{"source":7}],"images":[])"),
        "textures[0].source");
}

TEST(HostileGltf, LightsAndCameras) {
    const auto with = [](const std::string& light) {
        return replaced(
            replaced(kTriangle, kNode, R"({"mesh":0,"extensions":{"KHR_lights_punctual":{"light":0}},)"),
            R"("meshes")", R"("extensions":{"KHR_lights_punctual":{"lights":[)" + light + R"(]}},"meshes")");
    };
    const std::string field = "nodes[0].KHR_lights_punctual.light";
    expectError(with(R"({"type":"lava"})"), field);
    expectError(with(R"({"type":"point","intensity":-3})"), field);
    expectError(with(R"({"type":"point","intensity":1e300})"), field);
    expectError(with(R"({"type":"spot","spot":{"innerConeAngle":0.5,"outerConeAngle":0.5}})"), field);
    const std::string camera =
        R"("cameras":[{"type":"perspective","perspective":{"yfov":-1,"znear":1}}],"meshes")";
    expectError(replaced(replaced(kTriangle, kNode, R"({"mesh":0,"camera":0,)"), R"("meshes")", camera),
                "nodes[0].camera");
}

// Names are never looked at: bytes that are no UTF-8 are the parser's to accept or refuse, with a message.
TEST(HostileGltf, NamesWithoutSense) {
    for (const char* name : {"\xff\xfe", "\xc3", "\\u0000", "\xed\xa0\x80"}) {
        const TemporaryFile file(
            "name.gltf", replaced(kTriangle, kNode, R"({"name":")" + std::string(name) + R"(","mesh":0,)"));
        const std::string error = errorOf(file.path());
        EXPECT_TRUE(error.empty() || error.find(file.path()) == 0) << error;
    }
}

// Numbers that are finite but as large as floats get: no arithmetic of the importer's may trip over them.
TEST(HostileGltf, LargestCoordinates) {
    const TemporaryFile file("far.gltf", replaced(kTriangle, "gD8AAAAA", "f38AAAAA"));   // 3.4e38 for 1
    std::vector<std::string> warnings;
    const samples::SceneData scene = samples::loadScene(file.path(), warnings);
    EXPECT_EQ(scene.instances.size(), 1u);
    (void)samples::frameScene(scene);
}

}   // namespace
