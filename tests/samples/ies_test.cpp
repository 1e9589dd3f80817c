// Photometric profiles and EXT_lights_ies.
#include "common/ies.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "common/scene_lights.h"

namespace {

using samples::PhotometricProfile;
using samples::readIes;

// A lamp that shines below only, twice as bright along x as along y, mirrored over both.
const std::string kLamp =
    "IESNA:LM-63-2002\r\n[TEST] none\r\n[MORE] TILT=not here\r\nTILT=NONE\r\n"
    "1 1000 2 3 2 1 2 0 0 0\r\n1 1 60\r\n0, 45 90\r\n0 90\r\n100 50 0\r\n100\r\n25 0\r\n";

double texel(const PhotometricProfile& profile, double horizontal, double vertical) {
    const auto x = static_cast<size_t>(horizontal / 360 * profile.image.width);
    const auto y = static_cast<size_t>(vertical / 180 * profile.image.height);
    return profile.image.rgba[4 * (y * profile.image.width + x)] / 255.0;
}

TEST(Ies, IntensityByDirection) {
    const PhotometricProfile lamp = readIes(kLamp);
    EXPECT_EQ(lamp.peak, 200);
    const double half = 180.0 / lamp.image.height / 2;   // texels are sampled at their centres
    for (double h : {2.0, 178.0, 182.0, 358.0}) EXPECT_NEAR(texel(lamp, h, 45), 0.5 - half / 90, 0.01) << h;
    for (double h : {88.0, 92.0, 268.0, 272.0}) EXPECT_NEAR(texel(lamp, h, 45), 0.25 - half / 180, 0.01) << h;
    EXPECT_NEAR(texel(lamp, 45, 45), 0.375 - half / 120, 0.01);
    EXPECT_NEAR(texel(lamp, 10, 0.1), 1, 0.01);
    EXPECT_EQ(texel(lamp, 10, 95), 0);
    // Of a lamp without horizontal angles, cos v in front: a quarter over the sphere.
    std::string cosine = "IES:LM-63-2019\nTILT=INCLUDE\n1\n2\n0 90\n1 0.9\n1 -1 1 91 1 1 1 0 0 0\n1 1 0\n";
    for (int v = 0; v <= 90; ++v) cosine += std::to_string(v) + "\n";
    cosine += "0\n";
    for (int v = 0; v <= 90; ++v) cosine += std::to_string(std::cos(v * 3.14159265358979 / 180)) + "\n";
    EXPECT_NEAR(double(readIes(cosine).mean), 0.25, 0.001);
}

TEST(Ies, MistakesAreNamed) {
    const auto error = [](std::string text) {
        try {
            (void)readIes(text);
        } catch (const std::runtime_error& e) {
            return std::string(e.what());
        }
        return std::string("none");
    };
    const auto with = [](const char* find, const char* replace) {
        std::string text = kLamp;
        return text.replace(text.find(find), std::string(find).size(), replace);
    };
    EXPECT_EQ(error(kLamp), "none");
    EXPECT_NE(error("").find("IES"), std::string::npos);
    EXPECT_NE(error("IESNA91\n").find("TILT"), std::string::npos);
    EXPECT_NE(error(with(" 3 2 1 ", " 3 2 2 ")).find("type"), std::string::npos);
    EXPECT_NE(error(with(" 3 2 1 ", " -3 2 1 ")).find("vertical"), std::string::npos);
    EXPECT_NE(error(with(" 3 2 1 ", " 1e9 2 1 ")).find("vertical"), std::string::npos);
    EXPECT_NE(error(with("0, 45 90", "0, 95 90")).find("ascend"), std::string::npos);
    EXPECT_NE(error(with("\r\n0 90\r\n", "\r\n0 70\r\n")).find("horizontal"), std::string::npos);
    EXPECT_NE(error(with("25 0", "25")).find("candela"), std::string::npos);
    EXPECT_NE(error(with("25 0", "25 nan")).find("candela"), std::string::npos);
    EXPECT_NE(error(with("25 0", "25 -1")).find("candela"), std::string::npos);
    for (size_t length = 0; length < kLamp.size() - 3; ++length)
        EXPECT_NE(error(kLamp.substr(0, length)), "none") << length;
}

TEST(Ies, GltfLights) {
    const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "restir_ies";
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "lamp.ies", std::ios::binary) << kLamp;
    const auto load = [&](const std::string& light, const std::string& instance) {
        const std::string file = (folder / "scene.gltf").string();
        std::ofstream(file)
            << R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"extensionsUsed":["EXT_lights_ies"],)"
            << R"("extensions":{"EXT_lights_ies":{"lights":[)" << light
            << R"(]}},"nodes":[{"translation":[1,2,3],)"
            << R"("rotation":[0.70710678,0,0,0.70710678],"scale":[3,3,3],"extensions":{"EXT_lights_ies":)"
            << instance << "}}]}";
        std::vector<std::string> warnings;
        samples::SceneData scene = samples::loadScene(file, warnings);
        EXPECT_TRUE(warnings.empty()) << warnings.front();
        return scene;
    };
    const samples::SceneData scene =
        load(R"({"uri":"lamp.ies"})", R"({"light":0,"multiplier":0.5,"color":[1,0.5,2]})");
    ASSERT_EQ(scene.punctual.size(), 1u);
    EXPECT_EQ(scene.punctual[0].intensity, glm::vec3(100, 50, 100));
    EXPECT_LT(glm::distance(scene.punctual[0].profileTurn * glm::vec3(0, 0, 1), glm::vec3(0, -1, 0)), 1e-6f);
    const samples::SceneLights lights = samples::makeSceneLights(scene);
    ASSERT_EQ(lights.lights.size(), 1u);
    EXPECT_EQ(lights.lights[0].texture, scene.punctual[0].profile);
    EXPECT_EQ(scene.textures.at(lights.lights[0].texture).wrapV, samples::Wrap::Clamp);
    EXPECT_LT(lights.lights[0].meanLuminance, 50);
    const auto error = [&](const char* light, const char* instance) {
        try {
            load(light, instance);
        } catch (const std::runtime_error& e) {
            return std::string(e.what());
        }
        return std::string("none");
    };
    const char* const text = R"({"uri":"data:application/x-ies-lm-63;base64,SUVT"})";   // "IES"
    EXPECT_NE(error(text, R"({"light":0})").find("lights[0]: IES profile: no line TILT="), std::string::npos);
    EXPECT_NE(error(text, R"({"light":1})").find("nodes[0].EXT_lights_ies.light"), std::string::npos);
    EXPECT_NE(error(R"({"uri":"none.ies"})", R"({"light":0})").find("none.ies"), std::string::npos);
    EXPECT_NE(error(R"({"bufferView":7})", R"({"light":0})").find("lights[0].bufferView"), std::string::npos);
    EXPECT_NE(error(R"({"uri":"lamp.ies"})", R"({"light":0,"multiplier":-1})").find("multiplier"),
              std::string::npos);
}

}   // namespace
