#include "image/gi_room.h"

#include <gtest/gtest.h>

namespace tests {

using namespace samples::build;

restir::Settings indirect() {
    restir::Settings settings = unbiased();
    settings.gi.mode = restir::IndirectMode::Restir;
    settings.gi.bounces = kGiBounces;
    settings.gi.radius = 8;   // short and near: more independent samples in a picture
    settings.gi.maxHistory = 4;
    return settings;
}

NamedSettings named(const std::string& name, const std::function<void(restir::GiSettings&)>& change) {
    restir::Settings settings = indirect();
    change(settings.gi);
    return {name, settings};
}

void expectAgreement(World& world, const ReferenceBlocks& truth, const std::vector<NamedSettings>& all,
                     uint32_t pictures, uint32_t frames) {
    Verdict verdict(all.size(), pictures);
    for (const NamedSettings& each : all) {
        samples::Sequence sequence{.view = world.view(), .frames = frames, .accumulate = true};
        SeedStatistics statistics;
        for (sequence.seed = 1000; sequence.seed < 1000 + pictures; ++sequence.seed) {
            statistics.add(world.render(sequence, each.settings));
            EXPECT_EQ(world.renderer().stats().counters.rejectedWeights, 0u);
        }
        verdict.add("gi " + each.name, compare(statistics, truth));
    }
    verdict.expectUnitVariance();
}

void expectReference(samples::SceneData scene, const std::vector<NamedSettings>& all,
                     uint32_t pictures) {
    World world(std::move(scene), kGiExtent);
    const samples::Sequence sequence{.view = world.view(), .frames = 4, .accumulate = true};
    expectAgreement(
        world, referenceFromSeeds(world.referenceSeeds(32, sequence, {.paths = 20, .bounces = kGiBounces})),
        all, pictures);
}

void addRoom(samples::SceneData& scene, const Surface& surface, glm::vec3 low, glm::vec3 high) {
    samples::Geometry walls{.material = addMaterial(scene, surface)};
    addBox(walls, low, high);
    for (size_t i = 0; i < walls.indices.size(); i += 3) std::swap(walls.indices[i], walls.indices[i + 1]);
    for (glm::vec3& normal : walls.normals) normal = -normal;
    addInstance(scene, addMesh(scene, {walls}));
}

samples::SceneData room(const Surface& boxes) {
    samples::SceneData scene;
    addRoom(scene, matte(), {-2, 0, -2}, {2, 3, 2});
    samples::Geometry things{.material = addMaterial(scene, boxes)};
    addBox(things, glm::vec3(-1.2f, 0, -1), glm::vec3(-0.4f, 1.2f, -0.2f));
    addBox(things, glm::vec3(0.3f, 0, -0.4f), glm::vec3(1.1f, 0.6f, 0.4f));
    addInstance(scene, addMesh(scene, {things}));
    addQuad(scene, lamp({0, 2.5f, 0.3f}, 0.5f), {.color = {0, 0, 0}, .emission = {6, 5, 4}, .specular = 0});
    scene.views.push_back({.eye = {0, 1.3f, 1.95f}, .target = {0, 0.8f, 0}, .verticalFov = 0.9f});
    return scene;
}

}   // namespace tests
