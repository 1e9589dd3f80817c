// Loading scenes: what the built-in ones hold, and that every mistake is one clear error.
#include "common/scene.h"

#include <algorithm>
#include <numeric>
#include <random>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "common/builtin.h"
#include "common/scene_lights.h"
#include "common/scene_options.h"
#include "common/sort_triangles.h"
#include "samples/gltf_file.h"

namespace {

using samples::SceneData;
using namespace tests;

SceneData load(const std::string& name) {
    std::vector<std::string> warnings;
    return samples::loadScene(name, warnings);
}

// What loading says went wrong; empty if nothing did.
std::string errorOf(const std::string& name) {
    try {
        load(name);
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return {};
}

void expectError(const std::string& name, const std::string& word) {
    const std::string error = errorOf(name);
    EXPECT_NE(error.find(word), std::string::npos) << name << " said: '" << error << "', without " << word;
    EXPECT_EQ(error.find('\n'), std::string::npos) << error;
}

struct Counts {
    uint64_t triangles = 0, emissive = 0;
};

Counts countOf(const SceneData& scene) {
    Counts counts;
    for (const samples::Instance& instance : scene.instances) {
        for (const samples::Geometry& geometry : scene.meshes[instance.mesh].geometries) {
            const auto& e = scene.materials[geometry.material].emission;
            counts.triangles += geometry.indices.size() / 3;
            if (e.x + e.y + e.z > 0) counts.emissive += geometry.indices.size() / 3;
        }
    }
    return counts;
}

// Indices within range: what GpuScene and the shaders rely on.
void expectSound(const SceneData& scene) {
    for (const samples::Instance& instance : scene.instances) ASSERT_LT(instance.mesh, scene.meshes.size());
    for (const samples::Mesh& mesh : scene.meshes) {
        for (const samples::Geometry& geometry : mesh.geometries) {
            ASSERT_LT(geometry.material, scene.materials.size());
            ASSERT_EQ(geometry.indices.size() % 3, 0u);
            for (uint32_t index : geometry.indices) ASSERT_LT(index, geometry.positions.size());
            ASSERT_TRUE(geometry.normals.empty() || geometry.normals.size() == geometry.positions.size());
            ASSERT_TRUE(geometry.uvs.empty() || geometry.uvs.size() == geometry.positions.size());
        }
    }
    for (const auto& material : scene.materials)
        for (uint32_t texture : {material.baseColorTexture, material.metallicRoughnessTexture,
                                 material.normalTexture, material.emissionTexture})
            ASSERT_TRUE(texture == RS_NO_TEXTURE || texture < scene.textures.size());
    for (const auto& texture : scene.textures) ASSERT_LT(texture.image, scene.images.size());
}

TEST(Scene, CornellHasAHundredLights) {
    const SceneData scene = load("builtin:cornell");
    expectSound(scene);
    EXPECT_EQ(countOf(scene).emissive, 100u);
    const samples::SceneLights lights = samples::makeSceneLights(scene);
    EXPECT_EQ(lights.lights.size(), 100u);
    EXPECT_EQ(lights.emissiveTriangles, 100u);
    EXPECT_FALSE(scene.views.empty());
}

TEST(Scene, RoomsHaveADoorAndALampThatGoesOut) {
    const SceneData scene = load("builtin:rooms");
    expectSound(scene);
    EXPECT_EQ(countOf(scene).emissive, 4u);
    const samples::SceneState rest = samples::restOf(scene);
    const auto at = [&](const char* animation, float time) {
        samples::SceneState state = rest;
        samples::findMotion(scene, animation)(time, state);
        return state;
    };
    for (float time : {-24.0f, -6.0f, 0.0f, 9.0f}) {
        EXPECT_NE(at("door", time).worldFromObject, at("door", time + 1).worldFromObject) << time;
        const bool dark = at("switch", time).emission != rest.emission;
        EXPECT_EQ(dark, time >= -2) << time;
    }
}

TEST(Scene, MarketHasThousandsOfLights) {
    const SceneData scene = load("builtin:market");
    expectSound(scene);
    EXPECT_GE(samples::makeSceneLights(scene).lights.size(), 2000u);
    EXPECT_FALSE(scene.textures.empty());
    EXPECT_FALSE(scene.views.empty());
}

TEST(Scene, CityHasAMillionLights) {
    const SceneData scene = load("builtin:city");
    EXPECT_EQ(countOf(scene).emissive, 1'040'384u);   // a LightTable takes 2^20
    EXPECT_FALSE(scene.views.empty());
}

TEST(Scene, StreetCountsAreExact) {
    for (const Counts& wanted : {Counts{1, 0}, Counts{1, 1}, Counts{999, 13}, Counts{100'000, 2'000},
                                 Counts{54'321, 54'321}, Counts{65'537, 0}}) {
        const SceneData scene = load("builtin:street?triangles=" + std::to_string(wanted.triangles) +
                                     "&emissive=" + std::to_string(wanted.emissive));
        expectSound(scene);
        EXPECT_EQ(countOf(scene).triangles, wanted.triangles);
        EXPECT_EQ(countOf(scene).emissive, wanted.emissive);
    }
}

struct LampsOf {
    const char* kind;
    std::vector<std::pair<restir::LightKind, size_t>> lights;
    bool textured = false;
};
const std::vector<LampsOf>& lamps() {
    using enum restir::LightKind;
    static const std::vector<LampsOf> kLamps = {
        {"triangle", {{Triangle, 9}}},
        {"textured", {{Triangle, 18}}, true},
        {"sphere", {{Sphere, 9}}},
        {"disk", {{Disk, 9}}},
        {"rectangle", {{Rectangle, 9}}},
        {"capsule", {{Capsule, 9}}},
        {"point", {{Point, 9}}},
        {"spot", {{Spot, 9}}},
        {"profile", {{Point, 5}, {Spot, 4}}, true},
        {"directional", {{Directional, 4}}},
        {"environment", {{Environment, 1}}, true},
        {"all",
         {{Triangle, 3},
          {Sphere, 1},
          {Disk, 1},
          {Rectangle, 1},
          {Capsule, 1},
          {Point, 2},
          {Spot, 1},
          {Directional, 1},
          {Environment, 1}}},
    };
    return kLamps;
}

TEST(Scene, LampsAreOfTheirKind) {
    for (const LampsOf& wanted : lamps()) {
        SCOPED_TRACE(wanted.kind);
        const SceneData scene = load(std::string("builtin:lamps?kind=") + wanted.kind);
        expectSound(scene);
        EXPECT_FALSE(scene.views.empty());
        const auto lights = samples::makeSceneLights(scene).lights;
        size_t all = 0;
        for (const auto& [kind, count] : wanted.lights) {
            EXPECT_EQ(std::ranges::count(lights, kind, &restir::Light::kind), ptrdiff_t(count));
            all += count;
        }
        EXPECT_EQ(lights.size(), all);
        const auto textured = [](const restir::Light& light) { return light.texture != RS_NO_TEXTURE; };
        EXPECT_TRUE(!wanted.textured || std::ranges::all_of(lights, textured));
    }
    EXPECT_EQ(samples::build::lampKinds().size(), lamps().size());
    EXPECT_EQ(load("builtin:lamps").name, load("builtin:lamps?kind=all").name);
}

float farthest(const float (&a)[3], const float (&b)[3]) {
    return std::max({std::abs(a[0] - b[0]), std::abs(a[1] - b[1]), std::abs(a[2] - b[2])});
}

// Lamps stay what they are while they move, and none jumps.
TEST(Scene, LampsMove) {
    for (const std::string_view kind : samples::build::lampKinds()) {
        SCOPED_TRACE(kind);
        const SceneData scene = load("builtin:lamps?kind=" + std::string(kind));
        const samples::SceneLights rest = samples::makeSceneLights(scene);
        const samples::Motion motion = samples::findMotion(scene, "lights");
        const auto at = [&](float time) {
            samples::SceneState state = samples::restOf(scene);
            motion(time, state);
            return samples::lightsAt(rest, state);
        };
        for (float time = -32; time < 0; ++time) {
            const auto before = at(time), after = at(time + 1);
            ASSERT_EQ(before.size(), rest.lights.size());
            ASSERT_EQ(after.size(), before.size());
            for (size_t i = 0; i < after.size(); ++i) {
                EXPECT_EQ(after[i].kind, before[i].kind);
                EXPECT_EQ(after[i].texture, rest.lights[i].texture);
                const float turned = std::abs(after[i].rotation[1] - before[i].rotation[1]) +
                                     std::abs(after[i].rotation[3] - before[i].rotation[3]);
                EXPECT_GT(farthest(after[i].position, before[i].position) +
                              farthest(after[i].direction, before[i].direction) + turned,
                          1e-3f);
                EXPECT_LT(farthest(after[i].position, before[i].position), 0.15f);
            }
        }
    }
}

TEST(Scene, BuiltinMistakesAreNamed) {
    expectError("builtin:nowhere", "nowhere");
    expectError("builtin:", "builtin");
    expectError("builtin:street?lamps=3", "lamps");
    expectError("builtin:street?triangles=-3", "triangles");
    expectError("builtin:street?triangles=many", "triangles");
    expectError("builtin:street?triangles=0", "triangles");
    expectError("builtin:street?triangles=10&emissive=11", "emissive");
    expectError("builtin:cornell?triangles=3", "triangles=3");
    expectError("builtin:lamps?kind=neon", "neon");
    expectError("builtin:lamps?kind=", "environment");
    expectError("builtin:lamps?lamp=sphere", "lamp");
}

// What results are filed under.
TEST(Scene, TextTellsScenesApart) {
    EXPECT_EQ(samples::sceneText({.scene = "builtin:cornell"}), "builtin:cornell");
    EXPECT_EQ(samples::sceneText({.scene = "room.glb",
                                  .environment = "skies/noon.hdr",
                                  .environmentRotation = 90,
                                  .environmentScale = 0.5f,
                                  .lambert = true,
                                  .eye = "1,2,3",
                                  .target = "0,0,0",
                                  .fov = 60}),
              "room.glb --eye 1,2,3 --target 0,0,0 --fov 60 --lambert --env noon.hdr --env-rotation 90 --env-scale 0.5");
    EXPECT_EQ(samples::sceneText({.scene = "room.glb", .camera = 2}), "room.glb --camera 2");
}

TEST(Scene, FilesThatAreNotThere) {
    expectError("/nowhere/scene.gltf", "/nowhere/scene.gltf");
    expectError("/nowhere/scene.glb", "/nowhere/scene.glb");
    expectError("", "");
    EXPECT_FALSE(errorOf("").empty());
}

TEST(Scene, ReadsATriangle) {
    const TemporaryFile file("triangle.gltf", kTriangle);
    const SceneData scene = load(file.path());
    expectSound(scene);
    ASSERT_EQ(countOf(scene).triangles, 1u);
    ASSERT_EQ(scene.instances.size(), 1u);
    EXPECT_EQ(scene.instances[0].worldFromObject[3], glm::vec4(5, 0, 0, 1));
    const samples::View view = samples::frameScene(scene);
    EXPECT_NEAR(view.target.x, 5.5, 1e-5);
    EXPECT_NEAR(view.target.y, 0.5, 1e-5);
}

// kTriangle with a texture of one texel, its positions read as coordinates, too: (0, 0), (1, 0) and (0, 1).
std::string texturedTriangle(const std::string& material) {
    std::string text = replaced(kTriangle, R"("POSITION":0})", R"("POSITION":0,"TEXCOORD_0":1},"material":0)");
    text = replaced(text, R"("max":[1,1,0]})", R"("max":[1,1,0]},{"bufferView":1,"componentType":5126,"count":3,"type":"VEC2"})");
    text = replaced(text, R"("byteLength":36}],
"accessors")", R"("byteLength":36},{"buffer":0,"byteLength":32,"byteStride":12}],
"accessors")");
    return replaced(text, R"("meshes")", R"("materials":[)" + material + R"(],"textures":[{"source":0}],"images":[{"uri":
"data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNk+M/wHwAEBgIApD5fRAAAAABJRU5ErkJggg=="}],"meshes")");
}

// Rotation is counter-clockwise in a picture whose v points down.
TEST(Scene, TextureTransforms) {
    const std::string transform =
        R"("extensions":{"KHR_texture_transform":{"offset":[0.25,0.5],"rotation":1.57079632679,"scale":[2,4]}})";
    const std::string base = R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0,)" + transform + "}}";
    const auto check = [](const std::string& material, size_t warnings) {
        const TemporaryFile file("transformed.gltf", texturedTriangle(material));
        std::vector<std::string> said;
        const SceneData scene = samples::loadScene(file.path(), said);
        EXPECT_EQ(said.size(), warnings) << (said.empty() ? "" : said[0]);
        expectSound(scene);
        const glm::vec2 wanted[] = {{0.25f, 0.5f}, {0.25f, -1.5f}, {4.25f, 0.5f}};
        const auto& uvs = scene.meshes[0].geometries[0].uvs;
        ASSERT_EQ(uvs.size(), 3u);
        for (size_t i = 0; i < 3; ++i) EXPECT_LT(glm::distance(uvs[i], wanted[i]), 1e-5f) << i;
    };
    check(base + "}", 0);
    check(base + R"(,"emissiveTexture":{"index":0,)" + transform + "}}", 0);
    check(base + R"(,"emissiveTexture":{"index":0}})", 1);   // one set of coordinates for both
}

// Every triangle comes back once, with its corners in their order.
TEST(SortTriangles, IsAPermutation) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> coordinate(-5, 5);
    for (uint32_t count : {0u, 1u, 2u, 3u, 17u, 1000u}) {
        std::vector<glm::vec3> positions(3 * size_t{count});
        for (glm::vec3& p : positions) p = {coordinate(random), coordinate(random), coordinate(random)};
        std::vector<uint32_t> indices(positions.size());
        std::iota(indices.begin(), indices.end(), 0u);
        samples::sortTriangles(positions, indices);
        std::vector<uint32_t> firsts;
        for (size_t i = 0; i < indices.size(); i += 3) {
            firsts.push_back(indices[i]);
            EXPECT_EQ(indices[i + 1], indices[i] + 1);
            EXPECT_EQ(indices[i + 2], indices[i] + 2);
        }
        std::sort(firsts.begin(), firsts.end());
        ASSERT_EQ(firsts.size(), count);
        for (uint32_t i = 0; i < count; ++i) EXPECT_EQ(firsts[i], 3 * i);
    }
}

// Each half of the range lies on one side of a plane across the longest axis.
TEST(SortTriangles, SplitsTheLongestAxis) {
    std::mt19937 random(4);
    std::uniform_real_distribution<float> unit(0, 1);
    std::vector<glm::vec3> centroids(501);
    for (glm::vec3& c : centroids) c = {unit(random), 10 * unit(random), unit(random)};
    const std::vector<uint32_t> order = samples::spatialOrder(centroids);
    float low = -1, high = 11;
    for (size_t i = 0; i < order.size(); ++i) {
        const float y = centroids[order[i]].y;
        if (i <= 250)
            low = std::max(low, y);
        else
            high = std::min(high, y);
    }
    EXPECT_LE(low, high);
}

}   // namespace
