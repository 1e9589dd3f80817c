// Animations: what they do to a scene's lights, and that they are functions of time.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <set>
#include <stdexcept>

#include <common/prepare_scene.h>
#include <common/scene_lights.h>

namespace {

using namespace samples;

SceneData prepared(const char* name) {
    SceneData scene = makeBuiltin(name);
    prepareScene(scene);
    return scene;
}

SceneState stateAt(const SceneData& scene, const Motion& motion, float time) {
    SceneState state = restOf(scene);
    motion(time, state);
    return state;
}

bool same(const std::vector<restir::Light>& a, const std::vector<restir::Light>& b) {
    const auto equal = [](const restir::Light& x, const restir::Light& y) {
        return x.id == y.id && std::equal(x.position, x.position + 3, y.position) &&
               std::equal(x.vertex1, x.vertex1 + 3, y.vertex1) &&
               std::equal(x.vertex2, x.vertex2 + 3, y.vertex2) &&
               std::equal(x.emission, x.emission + 3, y.emission) && x.meanLuminance == y.meanLuminance;
    };
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), equal);
}

TEST(Animation, RestIsTheSceneItself) {
    for (const char* name : {"cornell", "market"}) {
        const SceneData scene = prepared(name);
        const SceneLights rest = makeSceneLights(scene);
        ASSERT_EQ(rest.sources.size(), rest.lights.size());
        EXPECT_TRUE(same(lightsAt(rest, restOf(scene)), rest.lights)) << name;
    }
}

TEST(Animation, DependsOnTimeOnlyAndMovesSomething) {
    for (const char* name : {"cornell", "market"}) {
        const SceneData scene = prepared(name);
        ASSERT_FALSE(scene.animations.empty());
        for (const Animation& animation : scene.animations) {
            const SceneState one = stateAt(scene, animation.motion, -7),
                             again = stateAt(scene, animation.motion, -7);
            const SceneState later = stateAt(scene, animation.motion, -6);
            ASSERT_EQ(one.worldFromObject.size(), scene.instances.size());
            EXPECT_TRUE(one.worldFromObject == again.worldFromObject && one.emission == again.emission);
            EXPECT_TRUE(one.worldFromObject != later.worldFromObject || one.emission != later.emission)
                << name << ' ' << animation.name;
        }
    }
}

TEST(Animation, SwitchedOffLightsLeaveTheListAndComeBackUnderTheirIds) {
    const SceneData scene = prepared("cornell");
    const SceneLights rest = makeSceneLights(scene);
    const Motion motion = findMotion(scene, "switching");
    std::set<uint32_t> all, seen;
    for (const restir::Light& light : rest.lights) all.insert(light.id);
    for (int time = -8; time <= 0; ++time) {
        const auto lights = lightsAt(rest, stateAt(scene, motion, float(time)));
        EXPECT_NEAR(double(lights.size()), double(all.size()) * 2 / 3, 8) << time;
        for (const restir::Light& light : lights) seen.insert(light.id);
    }
    EXPECT_EQ(seen, all);
}

TEST(Animation, UnknownNameListsThoseThereAre) {
    try {
        findMotion(makeBuiltin("cornell"), "dance");
        FAIL();
    } catch (const std::runtime_error& error) {
        EXPECT_NE(std::strstr(error.what(), "'dance'"), nullptr);
        EXPECT_NE(std::strstr(error.what(), "switching"), nullptr);
    }
}

}   // namespace
